"""Numbers that have to grow before a loop goes on, see ``counted_tests.py``."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator

from ros2cc_extract.extract.static.python.values.values import Class, Const, Instance, Value
from ros2cc_extract.light_dataclasses import dataclass

MOST = 3
"""A model counts no more writes than these: a giver of so many gives more."""


@dataclass(frozen=True)
class Step:
    """
    A write that lets a number grow.

    :param repeats: one run may do it several times.
    """

    by: float
    repeats: bool = False


@dataclass(frozen=True)
class Rise:
    """
    What a loop waits for: a number that grows.

    :param owner: the object whose attribute ``name`` it is.
    :param least: from which number on the loop goes on.
    """

    owner: Instance
    name: str
    least: float

    def writes_left(
        self, first: Iterable[Value], steps: Collection[Step], mine: int
    ) -> int | None:
        """
        How many writes are missing; ``None`` where that is not known.

        :param first: what is stored there before the first write.
        :param mine: how many writes the waiting code has made before.
        """
        values: list[float] = [value.value for value in first if isinstance(value, Const)]
        by = {step.by for step in steps}
        if len(values) != 1 or not is_number(values[0]) or len(by) != 1 or min(by) <= 0:
            return None
        return math.ceil((self.least - values[0]) / min(by)) - mine

    @property
    def of_class(self) -> Iterator[Value]:
        """What the class of the object has under that name."""
        slots = (cls.slots for cls in self.owner.mro if isinstance(cls, Class))
        found = next((each[self.name] for each in slots if self.name in each), None)
        if isinstance(found, Value):
            yield found


def is_number(value: object) -> bool:
    """Whether it is one to count with."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)
