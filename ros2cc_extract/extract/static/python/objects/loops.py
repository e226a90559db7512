"""Loops: known sequences are unrolled, unknown ones run once and counted as unknown."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ros2cc_extract.extract.static.python.machine.library_state import LibraryState
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.machine.waitable_objects import is_waited_on
from ros2cc_extract.extract.static.python.values.assumed_defaults import (
    items_by_default,
)
from ros2cc_extract.extract.static.python.values.containers import Collection, Mapping, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    NONE,
    Bound,
    Choice,
    Class,
    Const,
    Function,
    Instance,
    Mystery,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.extract.static.python.values.values import choice as join
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import When

UNROLL_LIMIT = 64

_NEXT, _RETURN, _BREAK, _CONTINUE = 1, 2, 4, 8
_OUT = _RETURN | _BREAK
_LEAVING = (ast.Return, ast.Raise, ast.Break, ast.Continue)


@dataclass(frozen=True)
class Items:
    """
    What a loop goes over.

    :param known: the items that are known, in order.
    :param others: why there may be some that no known one stands for.
    :param many: as in ``Collection``.
    :param assumed: the rule by which these are assumed to be all.
    """

    known: tuple[Value, ...]
    others: Unknown | None
    many: dict[Value, Value]
    assumed: str | None = None

    def why_many(self, item: Value) -> Unknown | None:
        """Why ``item`` stands for any number of items, ``None`` when it is one."""
        whys = [self.many.get(each, NONE) for each in (item, *options_of(item))]
        found = [o.unknown for why in whys for o in options_of(why) if isinstance(o, Mystery)]
        return found[0] if found else None


def items_in(machine: Machine, value: Value, place: Place) -> Items:
    """What a loop over ``value`` goes over."""
    options = options_of(value)
    if len(options) > 1 and all(isinstance(option, Collection) for option in options):
        return _one_of([items_in(machine, option, place) for option in options])
    known, rest = machine.items_of(value, place)
    if not isinstance(value, Collection):
        return Items(known, rest, {})
    others = value.others
    if not known and others is None and may_be_filled(machine, value):
        others = Unknown('it is filled when the program runs', place)
    return Items(known, others, value.many)


def items_to_run(machine: Machine, value: Value, place: Place) -> Items:
    """What a loop runs over; a list that is a default by assumption."""
    known = items_by_default(value)
    if known and isinstance(value, Mystery):
        return Items(known, None, {}, machine.assumption('number', value))
    return items_in(machine, value, place)


def _one_of(items: list[Items]) -> Items:
    """What a loop over one of several collections goes over."""
    each_present = [{_present(item): item for item in each.known} for each in items]
    known = dict.fromkeys(item for each in each_present for item in each)
    return Items(
        tuple(
            item
            if all(item in each and each[item] is _present(each[item]) for each in each_present)
            else join([item, ABSENT])
            for item in known
        ),
        next((each.others for each in items if each.others is not None), None),
        {item: why for each in items for item, why in each.many.items()},
    )


def _present(item: Value) -> Value:
    """The one value that ``item`` is where it is there at all."""
    options = options_of(item)
    return options[0] if len(options) == 1 else item


def set_of(items: Items, place: Place) -> Sequence:
    """
    The set of ``items``, in which equal ones are one.

    Those that could not be followed may be equal: one stands for any number of them.
    """
    known = tuple(dict.fromkeys(items.known))
    unknown = [item for item in known if any(isinstance(o, Mystery) for o in options_of(item))]
    if len(known) < 2 or not unknown:
        return Sequence(known, 'set', items.others, items.many)
    why = Unknown('items of a set, which may be equal', place)
    any_of_them = Mystery(why, 'item')
    rest = tuple(item for item in known if item not in unknown)
    many = {**items.many, any_of_them: Mystery(why)}
    return Sequence((*rest, any_of_them), 'set', items.others, many)


def may_be_filled(machine: Machine, value: Collection) -> bool:
    """Whether callbacks or methods that are followed later may have put something into it."""
    is_fixed = isinstance(value, Sequence) and value.kind in ('tuple', 'range')
    return not is_fixed and machine.world.when is not When.START


@contextmanager
def counted(machine: Machine, count: int | Unknown) -> Iterator[None]:
    """Everything made inside is made ``count`` times as often."""
    before, depth = machine.world.count, machine.world.loop_depth
    if machine.world.open_loops == 0:
        machine.world.begin_outermost_loop()
    machine.world.open_loops += isinstance(count, Unknown)
    if isinstance(count, Unknown):
        machine.world.loop_depth = len(machine.stack)
    if isinstance(count, Unknown) or isinstance(before, Unknown):
        machine.world.count = before if isinstance(before, Unknown) else count
    else:
        machine.world.count = before * count
    try:
        yield
    finally:
        machine.world.count, machine.world.loop_depth = before, depth
        machine.world.open_loops -= isinstance(count, Unknown)


@contextmanager
def repeated(
    machine: Machine, items: Items, body: list[ast.stmt]
) -> Iterator[Callable[[Value], None]]:
    """
    What is done inside is done once for each item, if nothing leaves a round of the loop.

    Yields a function to call with the item with which a round begins.
    """
    world = machine.world
    before = world.round, world.times
    is_known = items.others is None and not any(
        items.why_many(item) is not None or ABSENT in options_of(item) for item in items.known
    )
    leaves = any(isinstance(part, _LEAVING) for statement in body for part in ast.walk(statement))
    is_counted = is_known and not leaves
    if is_counted and len(items.known) > UNROLL_LIMIT:
        world.times *= len(items.known)
    rounds = 0

    def begin(_item: Value) -> None:
        nonlocal rounds
        rounds += 1
        if is_known:
            # At most so many where the loop may be left: such a round has a negative number.
            world.round = (*before[0], rounds if is_counted else -rounds)

    try:
        yield begin
    finally:
        world.round, world.times = before


def run_loop(machine: Machine, items: Items, once: Callable[[Value], int], place: Place) -> int:
    """Run the body of a ``for`` loop; returns how it may end, ``BREAK`` distinct from ``NEXT``."""
    path, ends = machine.world.path, 0
    assumed, effects = machine.world.assumed, machine.world.effects or EffectLog()
    machine.world.assumed = items.assumed or assumed
    several = len(items.known) > 1
    effects.loops += several
    try:
        if len(items.known) > UNROLL_LIMIT:
            return _run_many(machine, items, once, place)
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
        machine.world.path, machine.world.assumed = path, assumed
        effects.loops -= several


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


def _run_many(machine: Machine, items: Items, once: Callable[[Value], int], place: Place) -> int:
    number = len(items.known)
    reason = f'one of {number} items of a loop'
    more = items.others
    why = Unknown(f'made in a loop: {more.reason}', more.at or place) if more else None
    with counted(machine, why or number):
        flow = once(Mystery(Unknown(reason, place), 'item'))
    return flow & _OUT | _NEXT if flow & (_NEXT | _BREAK | _CONTINUE) else flow


def after_loop(flow: int) -> int:
    """How a loop may end whose body may end by ``flow``."""
    if flow & _RETURN and not flow & (_NEXT | _BREAK | _CONTINUE):
        return flow
    return (flow & ~(_BREAK | _CONTINUE)) | _NEXT if flow & ~16 else flow


def any_of(owner: Collection) -> Value | None:
    """One of what is there: objects of the program, classes and functions, entities."""
    held = owner.items if isinstance(owner, Sequence) else ()
    values = owner.entries.values() if isinstance(owner, Mapping) else held
    found = [option for value in values for option in options_of(value) if option is not ABSENT]
    if found and all(_is_entity(value) or is_waited_on(value) for value in found):
        return join(found)
    if found and owner.others is None and all(_is_own_object(value) for value in found):
        return join(found)
    are_called = all(isinstance(value, _CALLABLE) for value in found)
    return join(found) if found and are_called and owner.others is None else None


_CALLABLE = (Class, Function, Bound, Partial)


def _is_entity(value: Value) -> bool:
    return (
        isinstance(value, Instance)
        and isinstance(value.state, LibraryState)
        and value.state.is_one_of_many
    )


def _is_own_object(value: Value) -> bool:
    """What its methods wait for, and what they do, is in the program."""
    return isinstance(value, Instance) and isinstance(value.cls, Class)


def is_key(value: Value) -> bool:
    """Whether ``value`` is certain enough to be a dictionary key."""
    return isinstance(value, (Const, Instance)) or (
        not isinstance(value, (Mystery, Choice)) and value.__hash__ is not None
    )


def has_key(owner: Value, key: Value) -> bool:
    """Whether ``key`` is surely in a dictionary already: storing under it changes no size."""
    held = owner.entries.get(key) if isinstance(owner, Mapping) and is_key(key) else None
    return held is not None and not (isinstance(held, Choice) and ABSENT in held.options)


def key_text(value: Value) -> str:
    """A name for what is stored under ``value``."""
    return str(value.value) if isinstance(value, Const) else 'item'


def index_of(value: Value, length: int) -> int | None:
    """``value`` as an index into ``length`` items."""
    if isinstance(value, Const) and isinstance(value.value, int):
        index = value.value + length if value.value < 0 else value.value
        return index if 0 <= index < length else None
    return None
