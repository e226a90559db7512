"""Report releases of rclpy that were never examined: none is silently taken for another."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TextIO

from ros2cc_extract.spec.releases.lines import judged_as


def report_releases(releases: Iterable[str | None], stderr: TextIO) -> None:
    """Say what each of them is judged as, once."""
    for release in dict.fromkeys(filter(None, releases)):
        words = judged_as(release)
        if words is not None:
            print(words, file=stderr)
