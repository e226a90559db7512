"""What ``id(…)`` gives: not known, but one order of all objects in the whole program."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.values.values import Instance, Mystery
from ros2cc_extract.source_locations import Place, Unknown


class Identity(Mystery):
    """``id(thing)``; the order in which things were made stands for that of their numbers."""

    __slots__ = ('thing',)

    def __init__(self, thing: Instance, place: Place) -> None:
        super().__init__(Unknown('id() of an object', place), 'id(…)')
        self.thing = thing
