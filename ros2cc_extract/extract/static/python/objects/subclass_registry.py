"""Registries that Python keeps by itself: the subclasses of a class."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import Call, Class, Value, options_of
from ros2cc_extract.source_locations import Unknown


def register(world: World, cls: Class) -> None:
    """Make ``cls`` known to its bases."""
    for base in cls.bases:
        for option in options_of(base):
            if isinstance(option, Class):
                world.subclasses.setdefault(option, []).append(cls)


def subclasses_of(machine: Machine, receiver: Value, call: Call) -> Value:
    """
    ``cls.__subclasses__()``: those of the modules that the program has imported by then.

    A class without any, which is no subclass itself, is taken to get them from elsewhere.
    """
    assert isinstance(receiver, Class)
    known = tuple(machine.world.subclasses.get(receiver, ()))
    is_root = not any(isinstance(base, Class) for base in receiver.bases)
    if known or not is_root:
        return Sequence(known)
    reason = f'subclasses of {receiver.name}, none of which the program is known to import'
    return Sequence((), 'list', Unknown(reason, call.place))
