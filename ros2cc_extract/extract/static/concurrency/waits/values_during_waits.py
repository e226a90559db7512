"""
What callbacks meet in attributes while the set-up waits or spins, and what it replaces afterwards.

``main`` waits for ``self.observed``, puts a new future there, and waits for that one. Callbacks
are followed when all of ``main`` has been, but they run while it waits, and find there what it
waits for. Of what comes from one place the first is enough: what ends the wait for one of them
ends it for all (``units/waits.py``, ``wakings_of``).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.python.machine.store import Store
from ros2cc_extract.extract.static.python.machine.waitable_objects import is_waited_on
from ros2cc_extract.extract.static.python.values.values import (
    Heaped,
    Instance,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.spec.model import When


def note_kept(world: ConcurrentWorld, owner: Heaped, name: str, value: Value) -> None:
    """``value`` is stored in an attribute."""
    for each in options_of(value):
        if is_waited_on(each):
            world.kept_in[each] = (owner, name)


def note_met(world: ConcurrentWorld, thing: Instance | None) -> None:
    """The set-up waits for ``thing``: callbacks that run meanwhile find it where it is kept."""
    if thing is None or (home := world.kept_in.get(thing)) is None:
        return
    held = home[0].slots.get(home[1])
    if isinstance(held, Value) and any(each is thing for each in options_of(held)):
        known = world.met_meanwhile.setdefault(home, {})
        known.setdefault((thing.cls, thing.place), thing)


def note_replaced(world: ConcurrentWorld, owner: Value, name: str, old: Value) -> None:
    """The set-up, which has spun, puts something else there: callbacks have met ``old``."""
    is_late = world.when is When.START and world.has_let_others_run and not world.in_thread
    if is_late and world.effects is None and isinstance(owner, Instance):
        for each in options_of(old):
            if isinstance(each, Instance):
                known = world.met_meanwhile.setdefault((owner, name), {})
                known.setdefault((each.cls, each.place), each)


def show_to_callbacks(world: ConcurrentWorld, store: Store) -> None:
    """Callbacks are followed now: they may find what was there while the set-up waited."""
    store.give_contents_back()
    for (owner, name), met in world.met_meanwhile.items():
        held = owner.slots.get(name)
        if isinstance(held, Value):
            store.write(owner, name, choice([*met.values(), held]))
