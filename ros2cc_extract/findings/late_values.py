"""An attribute is None until ``main`` gives it a value, and meanwhile callbacks run."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.findings.base.rule import Context
from ros2cc_extract.findings.base.wording import called
from ros2cc_extract.spec.model import ActivityKind, Spec


def used_before_main_gives_it(unit: Spec) -> Iterator[str]:
    """Say which callback uses it without a test; what comes first is not known."""
    mains = (one for one in unit.activities if one.kind is ActivityKind.MAIN)
    late = {write.name: write for main in mains for write in main.writes if write.fills_none}
    for callback in Context(unit).written:
        for use in (*callback.reads, *callback.writes):
            given = late.get(use.name) if use.bare else None
            if given is not None and given.source is not None:
                at = f'{given.source.file.rpartition("/")[2]}:{given.source.line}'
                yield (
                    f'{called(callback)} uses {use.name} without a test, which is None until main '
                    f'comes to {at}'
                )
