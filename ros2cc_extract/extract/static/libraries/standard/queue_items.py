"""
What is put into the queues of a program, for the code that takes it out.

Which item a consumer gets is not known: it is one of all that are put in. Until all is followed
each item is taken to be given away; at the end that is taken back of those that everybody in
sight who takes items has met.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import field

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.python.machine.waitable_objects import is_waited_on
from ros2cc_extract.extract.static.python.objects.escape import reached
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Class,
    Function,
    Instance,
    Library,
    Mystery,
    Partial,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import When

_PUT = 'it is put into a queue'
_MOST = 24


@dataclass
class Contents:
    """
    Of one queue.

    :param taken: how many items had been put in when one was taken last, by the place.
    """

    queue: Instance
    items: list[Value] = field(default_factory=list)
    taken: dict[Place, int] = field(default_factory=dict)

    @property
    def met(self) -> int:
        """How many items all consumers have met."""
        return min(self.taken.values(), default=0)


def give_items(machine: ConcurrentMachine, queue: Value, call: Call) -> None:
    """Something is put into ``queue``."""
    for item in (*call.args[:1], *call.keywords.values()):
        machine.give_away(item, _PUT, call.place)
        for option in options_of(queue):
            if isinstance(option, Instance) and _is_of_threads(option):
                contents = machine.world.queues.setdefault(id(option), Contents(option))
                if item not in contents.items:
                    contents.items.append(item)


def taken_out(machine: ConcurrentMachine, queue: Value, call: Call) -> Value | None:
    """One of the items, where there is any with which the program does something."""
    found: list[Value] = []
    for option in options_of(queue):
        if not isinstance(option, Instance) or not _is_of_threads(option):
            return None
        contents = machine.world.queues.setdefault(id(option), Contents(option))
        if machine.world.effects is not None or machine.world.when is not When.LATER:
            contents.taken[call.place] = len(contents.items)  # else nobody is known to call it
        found += (each for item in contents.items for each in options_of(item))
    if len(found) > _MOST or not any(map(_does_something, found)):
        return None
    unknown = [each for each in found if isinstance(each, Mystery)]
    others = [each for each in found if not isinstance(each, (Mystery, Sequence))]
    return choice([*_joined(found), *others, *unknown[:1]])


def take_back(world: ConcurrentWorld) -> None:
    """When all was followed: consumers have met the items, and end what they end."""
    queues = list(world.queues.values())
    lost = {id(each.queue): 0 if id(each.queue) in world.given else each.met for each in queues}
    left = [item for each in queues for item in each.items[lost[id(each.queue)] :]]
    met = [item for each in queues for item in each.items[: lost[id(each.queue)]]]
    away = {id(thing) for item in left for thing in reached(item)}
    for thing in (thing for item in met for thing in reached(item)):
        given = world.given.get(id(thing))
        if given is not None and given.reason == _PUT and id(thing) not in away:
            del world.given[id(thing)]


def _is_of_threads(queue: Instance) -> bool:
    """Queues of other processes give copies; code that awaits takes from those of loops."""
    return isinstance(queue.cls, Library) and queue.cls.name.startswith('queue.')


def _does_something(item: Value) -> bool:
    if isinstance(item, Sequence):
        return any(_does_something(option) for each in item.items for option in options_of(each))
    is_own = isinstance(item, Instance) and isinstance(item.cls, Class)
    return is_own or is_waited_on(item) or isinstance(item, (Bound, Function, Partial))


def _joined(found: Iterable[Value]) -> Iterator[Value]:
    """Of tuples of one length one, with all that may be at each place."""
    by_length: dict[int, list[Sequence]] = {}
    for each in found:
        if isinstance(each, Sequence) and each.rest is None:
            by_length.setdefault(len(each.items), []).append(each)
        elif isinstance(each, Sequence):
            yield each
    for alike in by_length.values():
        places = zip(*(each.items for each in alike), strict=True)
        options = ([o for value in place for o in options_of(value)] for place in places)
        yield Sequence(tuple(map(choice, options)))
