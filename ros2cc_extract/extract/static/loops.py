"""Loops: known sequences are unrolled, unknown ones run once and counted as unknown."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from ros2cc_extract.extract.static.machine import Machine
from ros2cc_extract.extract.static.values import (
    ABSENT,
    NONE,
    Choice,
    Collection,
    Const,
    Instance,
    Mystery,
    Value,
    options_of,
)
from ros2cc_extract.extract.static.values import choice as join
from ros2cc_extract.places import Place, Unknown

UNROLL_LIMIT = 64

_NEXT, _RETURN, _BREAK, _CONTINUE = 1, 2, 4, 8
_OUT = _RETURN | _BREAK


@dataclass(frozen=True)
class Items:
    """
    What a loop goes over.

    :param known: the items that are known, in order.
    :param others: why there may be some that no known one stands for.
    :param many: as in ``Collection``.
    """

    known: tuple[Value, ...]
    others: Unknown | None
    many: dict[Value, Value]

    def why_many(self, item: Value) -> Unknown | None:
        """Why ``item`` stands for any number of items, ``None`` when it is one."""
        whys = [self.many.get(option, NONE) for option in options_of(item)]
        found = [o.unknown for why in whys for o in options_of(why) if isinstance(o, Mystery)]
        return found[0] if found else None


def items_in(machine: Machine, value: Value, place: Place) -> Items:
    """What a loop over ``value`` goes over."""
    known, rest = machine.items_of(value, place)
    if isinstance(value, Collection):
        return Items(known, value.others, value.many)
    return Items(known, rest, {})


@contextmanager
def counted(machine: Machine, count: int | Unknown) -> Iterator[None]:
    """Everything made inside is made ``count`` times as often."""
    before = machine.world.count
    if isinstance(count, Unknown) or isinstance(before, Unknown):
        machine.world.count = before if isinstance(before, Unknown) else count
    else:
        machine.world.count = before * count
    try:
        yield
    finally:
        machine.world.count = before


def run_loop(machine: Machine, items: Items, once: Callable[[Value], int], place: Place) -> int:
    """Run the body of a ``for`` loop; returns how it may end, ``BREAK`` told from ``NEXT``."""
    path, ends = machine.world.path, 0
    try:
        if len(items.known) > UNROLL_LIMIT:
            return _run_many(machine, items.known, once, place)
        for item in items.known:
            why = items.why_many(item)
            if why is not None:
                with counted(machine, why):
                    ends |= _run_item(machine, item, once, place) & _OUT
                continue
            flow = _run_item(machine, item, once, place)
            ends |= flow & _OUT
            if flow & _BREAK and not flow & (_NEXT | _CONTINUE):
                return ends
            if flow and not flow & (_NEXT | _CONTINUE | _BREAK):
                return ends | (flow & ~_CONTINUE)
            if flow & (_BREAK | _RETURN):
                machine.world.path = (*machine.world.path, (place, -1))
        rest = items.others
        if rest is not None:
            with counted(machine, Unknown(f'made in a loop: {rest.reason}', rest.at or place)):
                item = Mystery(Unknown(f'loop variable: {rest.reason}', place), 'item')
                ends |= once(item) & _OUT
        return ends | _NEXT
    finally:
        machine.world.path = path


def _run_item(machine: Machine, item: Value, once: Callable[[Value], int], place: Place) -> int:
    if isinstance(item, Choice) and ABSENT in item.options:
        present = join([option for option in item.options if option is not ABSENT])
        flow = 0

        def attempt() -> Value:
            nonlocal flow
            flow = once(present)
            return present

        machine.branch([attempt, lambda: present], place)
        return flow | _NEXT
    return once(item)


def _run_many(
    machine: Machine, items: tuple[Value, ...], once: Callable[[Value], int], place: Place
) -> int:
    reason = f'one of {len(items)} items of a loop'
    with counted(machine, len(items)):
        flow = once(Mystery(Unknown(reason, place), 'item'))
    return flow & _OUT | _NEXT if flow & (_NEXT | _BREAK | _CONTINUE) else flow


def after_loop(flow: int) -> int:
    """How a loop may end whose body may end by ``flow``."""
    if flow & _RETURN and not flow & (_NEXT | _BREAK | _CONTINUE):
        return flow
    return (flow & ~(_BREAK | _CONTINUE)) | _NEXT if flow & ~16 else flow


def is_key(value: Value) -> bool:
    """Whether ``value`` is certain enough to be a dictionary key."""
    return isinstance(value, (Const, Instance)) or (
        not isinstance(value, (Mystery, Choice)) and value.__hash__ is not None
    )


def key_text(value: Value) -> str:
    """A name for what is stored under ``value``."""
    return str(value.value) if isinstance(value, Const) else 'item'


def index_of(value: Value, length: int) -> int | None:
    """``value`` as an index into ``length`` items."""
    if isinstance(value, Const) and isinstance(value.value, int):
        index = value.value + length if value.value < 0 else value.value
        return index if 0 <= index < length else None
    return None
