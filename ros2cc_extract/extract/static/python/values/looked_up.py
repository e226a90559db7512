"""What is found by a name that the program computes."""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.extract.static.python.values.values import Mystery, Value
from ros2cc_extract.source_locations import Unknown


class LookedUp(Mystery):
    """
    A value that is not known, though some functions are that it may be.

    :ivar functions: these.
    """

    __slots__ = ('functions',)

    def __init__(self, unknown: Unknown, text: str, functions: Sequence[Value]) -> None:
        super().__init__(unknown, text)
        self.functions = tuple(functions)
