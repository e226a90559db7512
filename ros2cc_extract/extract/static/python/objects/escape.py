"""What is inside of lists, tuples, dictionaries and objects that are handed on."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.static.python.machine.library_state import LibraryState
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.values.containers import Mapping, Sequence
from ros2cc_extract.extract.static.python.values.values import Instance, Native, Value, options_of
from ros2cc_extract.source_locations import Place

_MOST_GIVEN = 200


def note_kept(world: World, item: Value, place: Place) -> None:
    """
    A run puts something into a collection, out of which others take it.

    Code that takes items under unknown keys, or at other times, is not followed to an end.
    What is an attribute of an object of the program is known by its name.
    """
    if world.effects is None:
        return
    for option in options_of(item):
        is_own = isinstance(option, Instance) and option.state is None
        if isinstance(option, (Instance, Sequence, Mapping)) and not is_own:
            for thing in reached(option):
                world.kept_inside.setdefault(id(thing), place)


def reached(value: Value) -> Iterator[Instance]:
    """What others may wait on that is, or is inside of, what is handed on."""
    waiting, seen = list(options_of(value)), set[int]()
    while waiting and len(seen) < _MOST_GIVEN:
        thing = waiting.pop()
        thing = thing.receiver if isinstance(thing, Native) and thing.receiver else thing
        if id(thing) in seen:
            continue
        seen.add(id(thing))
        if isinstance(thing, Instance) and _may_end_waits(thing):
            yield thing
        elif isinstance(thing, Sequence):
            waiting.extend(each for item in thing.items for each in options_of(item))
        elif isinstance(thing, Mapping):
            values = thing.entries.values()
            waiting.extend(each for item in values for each in options_of(item))
        elif isinstance(thing, Instance) and thing.state is None:
            held = (item for item in thing.slots.values() if isinstance(item, Value))
            waiting.extend(each for item in held for each in options_of(item))


def _may_end_waits(thing: Instance) -> bool:
    return isinstance(thing.state, LibraryState) and thing.state.may_end_waits
