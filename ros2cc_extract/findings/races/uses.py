"""An access with who does it, and whether two of them may meet."""

from __future__ import annotations

from ros2cc_extract.findings.base.rule import Doer
from ros2cc_extract.findings.races.critical_sections import keep_apart
from ros2cc_extract.findings.races.made_later import comes_before
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Access


@dataclass(frozen=True)
class Use:
    """A write of an attribute by a callback or a thread, or a loop over it."""

    doer: Doer
    access: Access

    @property
    def place(self) -> Place:
        """Where it stands; the callback where the line is not known."""
        doer = self.doer
        return self.access.source or doer.defined or doer.source or Place(doer.name)


def may_meet(first: Use, second: Use) -> bool:
    """Whether no common lock keeps them apart, and neither is over before the other begins."""
    is_locked = keep_apart(first.access.locks, second.access.locks)
    return not is_locked and are_unordered(first, second)


def are_unordered(first: Use, second: Use) -> bool:
    """Whether neither is over before the other begins."""
    return not (
        comes_before(second.access, second.doer, first.doer)
        or comes_before(first.access, first.doer, second.doer)
    )
