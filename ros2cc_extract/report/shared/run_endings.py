"""What stands below the last step of a run."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.verify.results.evidence import Evidence


def closing_lines(run: Evidence) -> Iterator[str]:
    """Say what the run ends in, and how many steps were left out."""
    if run.closing:
        yield run.closing
    if run.left_out:
        yield f'({counted(run.left_out, "steps")} left out)'
