"""What an object of a library class has beyond its attributes, as the table says."""

from __future__ import annotations

from typing import ClassVar

from ros2cc_extract.extract.static.python.values.values import Instance, Value
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

BESIDE = '__as_thread__'
"""Slot of what else an object is, as a node may be a thread: each has its own methods."""


class LibraryState:
    """
    What the interpreter may take for granted of such an object stands in the class of its state.

    :cvar is_block: its library says itself what ``with`` does with it.
    :cvar is_one_of_many: one of those in a collection stands for any other one there.
    :cvar is_known_by_name: where branches decide which one a name means, each gets that name.
    :cvar is_made_once: code that asks whether there is one yet makes one at each place.
    :cvar is_beside: an object may be this in addition to what another base class makes of it.
    :cvar is_unit_of_its_own: a wait for it is a wait for what it serves.
    :cvar may_end_waits: code that has it may end what others wait for.
    """

    is_block: ClassVar[bool] = False
    is_one_of_many: ClassVar[bool] = False
    is_known_by_name: ClassVar[bool] = False
    is_made_once: ClassVar[bool] = False
    is_unit_of_its_own: ClassVar[bool] = False
    is_beside: ClassVar[bool] = False
    may_end_waits: ClassVar[bool] = False

    def owner_of(self, thing: Instance) -> Instance | None:
        """The object to which ``thing``, whose state this is, belongs with all that it runs."""
        return None

    def note_passed(self, function: str, place: Place) -> None:
        """It is passed to a function that is not followed."""

    def doubt(self, reason: str, place: Place | None) -> None:
        """It may be the same one as another, or have more than is seen."""


@dataclass(eq=False)
class PlainState(LibraryState):
    """A library object whose kind alone matters: a lock, an event, a publisher …"""

    is_block = True
    may_end_waits = True

    kind: str
    key: Value | None = None
    of: Value | None = None
    place: Place | None = None
