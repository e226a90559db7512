"""
Flags by which a callback keeps others out: ``if self.busy: return``, then ``self.busy = True``.

Code that finds a flag down and puts it up holds it, as a lock, until it is put down again; a
done-callback takes over what its maker holds, and the execute callback of an action server what
the goal callback holds wherever it accepts; where that has only found a flag down, the execute
callback may put it up. Whether the test and the setting are one piece, and
no other code puts the flag down, is decided by the reader of the accesses.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator

from ros2cc_extract.extract.static.concurrency.accesses.holders.closure_cells import is_own_name
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.python.machine.dependences import Reading
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Const,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import (
    FLAG,
    FOUND_FALSE,
    FOUND_NONE,
    FOUND_OTHER,
    FOUND_SOME,
    FOUND_THIS,
    FOUND_TRUE,
)

_THEN, _ELSE, _AFTER = 0, 1, -1
_LEAVING = (ast.Return, ast.Raise, ast.Continue, ast.Break)
_REFUSING = 'REJECT'
_Asked = tuple[str, bool, str]
Constant = Callable[[ast.expr], str | None]
"""Gives ``text_of`` what an expression stands for."""


def note_test(
    reading: Reading,
    node: ast.If,
    test: ast.expr,
    found: Iterable[str],
    place: Place,
    constant: Constant,
) -> None:
    """
    Note where the flags that an ``if`` asks for are down, together or each on its own.

    A state may stand for a flag: code that finds it to be a constant, and stores another one, or
    the other way round.

    :param test: that of ``node``, see ``behind_getters``.
    """
    names: dict[str, list[str]] = {}
    for name in found:
        names.setdefault(name.rpartition('.')[2], []).append(name + FLAG)
    steps = steps_of(node)
    for attribute, down_if, value in flags_asked(test, constant):
        meant = names.get(attribute, [])
        for step in steps[down_if] if len(meant) == 1 else ():
            known = reading.down.get((place, step), frozenset())
            reading.down[place, step] = known | set(meant)
            reading.found.setdefault((place, step), {})[meant[0].removesuffix(FLAG)] = value
    for attribute, up_if, value in _found_up(test):
        meant = names.get(attribute, [])
        for step in steps[up_if] if len(meant) == 1 else ():
            reading.found.setdefault((place, step), {})[meant[0].removesuffix(FLAG)] = value


def asked_in(test: ast.expr, constant: Constant) -> Iterator[_Asked]:
    """The names that a test asks for, what it gives then, and what they hold if it does."""
    yield from _found_up(test)
    yield from flags_asked(test, constant)


def steps_of(node: ast.If) -> dict[bool, tuple[int, ...]]:
    """The steps of the path on which the test of an ``if`` is true, and false."""
    is_split = bool(node.orelse) and not isinstance(node.orelse[0], ast.If)
    return {True: (_THEN,), False: (_AFTER,) if is_left(node) else (_ELSE,) if is_split else ()}


def is_left(node: ast.If) -> bool:
    """Whether what follows an ``if`` is done only where its test is false."""
    return not node.orelse and isinstance(node.body[-1], _LEAVING)


def flags_asked(test: ast.expr, constant: Constant) -> Iterator[_Asked]:
    """The flags that are down where all of ``test`` holds, or where nothing of it does."""
    if isinstance(test, ast.BoolOp):
        down_if = isinstance(test.op, ast.And)
        parts = [asked for value in test.values for asked in flags_asked(value, constant)]
        yield from (asked for asked in parts if asked[1] is down_if)
        return
    yield from _asked(test, constant)


def _found_up(test: ast.expr) -> Iterator[_Asked]:
    """The flags that are up where all of ``test`` holds, or where nothing of it does."""
    if isinstance(test, ast.BoolOp):
        up_if = isinstance(test.op, ast.And)
        parts = [found for value in test.values for found in _found_up(value)]
        yield from (found for found in parts if found[1] is up_if)
    elif isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        inner = _found_up(test.operand)
        yield from ((name, not up_if, value) for name, up_if, value in inner)
    elif isinstance(test, ast.Compare):
        # The other arm of a test for ``None``.
        asked = _asked(test, lambda _: None)
        yield from ((name, not is_none, FOUND_SOME) for name, is_none, _ in asked)
    elif _name_of(test) is not None:
        yield _name_of(test) or '', True, FOUND_TRUE


def _asked(test: ast.expr, constant: Constant) -> Iterator[_Asked]:
    """The flag that a test asks for, what it gives where that is down, and what it holds then."""
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        inner = _asked(test.operand, constant)
        yield from ((name, not down_if, value) for name, down_if, value in inner)
    elif isinstance(test, ast.Compare) and len(test.ops) == 1:
        is_same = _SAME.get(type(test.ops[0]))
        right, name = test.comparators[0], _name_of(test.left)
        if is_same is None or name is None:
            return
        if isinstance(right, ast.Constant) and right.value is None:
            if isinstance(test.ops[0], (ast.Is, ast.IsNot)):
                yield name, is_same, FOUND_NONE
            return
        text = constant(right)
        if text is not None:
            yield name, is_same, FOUND_THIS + text
            yield name, not is_same, FOUND_OTHER + text
    elif _name_of(test) is not None:
        yield _name_of(test) or '', False, FOUND_FALSE


_SAME: dict[type[ast.cmpop], bool] = {
    ast.Is: True,
    ast.Eq: True,
    ast.IsNot: False,
    ast.NotEq: False,
}


def behind_getters(machine: ConcurrentMachine, test: ast.expr, frame: Frame) -> ast.expr:
    """
    A test with the attribute for each call of a method that only gives one of its own.

    Names of the function's own become nameless: they are no shared data.
    """
    if isinstance(test, ast.UnaryOp):
        operand = behind_getters(machine, test.operand, frame)
        return test if operand is test.operand else ast.UnaryOp(test.op, operand)
    if isinstance(test, ast.BoolOp):
        values = [behind_getters(machine, value, frame) for value in test.values]
        return test if values == test.values else ast.BoolOp(test.op, values)
    if isinstance(test, ast.Compare) and isinstance(test.left, ast.Name):
        left = behind_getters(machine, test.left, frame)
        return test if left is test.left else ast.Compare(left, test.ops, test.comparators)
    if isinstance(test, ast.Name) and is_own_name(test.id, frame):
        return ast.Name('', test.ctx)  # it is called like an attribute at most
    if not isinstance(test, ast.Call) or test.args or not isinstance(test.func, ast.Attribute):
        return test
    noted, machine.world.effects = machine.world.effects, None
    with machine.world.reading.apart():
        method = machine.evaluate(test.func, frame)
    machine.world.effects = noted
    return (_given_by(method) if isinstance(method, Bound) else None) or test


def _given_by(method: Bound) -> ast.Attribute | None:
    """``self.busy`` of a method that does nothing but return it."""
    node = method.function.node
    if not isinstance(node, ast.FunctionDef) or not node.args.args:
        return None
    last = node.body[-1]
    is_short = len(node.body) == 1 + (ast.get_docstring(node) is not None)
    value = last.value if is_short and isinstance(last, ast.Return) else None
    is_own = isinstance(value, ast.Attribute) and isinstance(value.value, ast.Name)
    return value if is_own and value.value.id == node.args.args[0].arg else None  # type: ignore[union-attr,return-value]


def _name_of(test: ast.expr) -> str | None:
    if isinstance(test, ast.Attribute):
        return test.attr
    return test.id if isinstance(test, ast.Name) else None


def constant_text(machine: ConcurrentMachine, value: ast.expr, frame: Frame) -> str | None:
    """What a name, or an attribute, or a literal stands for, if that is one constant."""
    if not isinstance(value, (ast.Name, ast.Attribute, ast.Constant)):
        return None
    with machine.world.reading.apart():
        return text_of(machine.evaluate(value, frame))


def text_of(value: Value) -> str | None:
    """The same for constants that are equal, ``None`` for what is no constant."""
    known = isinstance(value, Const) and value.value is not None
    return repr(value.value) if known else None  # type: ignore[attr-defined]


def put_up(world: ConcurrentWorld, name: str) -> None:
    """Note that ``name`` is stored; code that found it down and stores something holds it now."""
    flag = name + FLAG
    is_down = flag in _found_down(world) or (flag in world.still_down and not has_waited(world))
    if is_down and flag not in world.held and _is_up(world, name):
        world.held = (*world.held, flag)
        world.flag_tests.setdefault(name, set()).update(_states_found(world, name)[-1:])


def has_waited(world: ConcurrentWorld) -> bool:
    """Whether the followed code may have waited by now."""
    return world.effects is not None and world.effects.behind is not None


def put_down(world: ConcurrentWorld, name: str) -> None:
    """Note that ``name`` was stored; code that puts down its flag no longer holds it."""
    stored = world.reading.stored
    states = world.flag_tests.get(name)
    if states:
        is_down = not all(_is_up_for(stored, each) for each in states)
    else:
        is_down = isinstance(stored, Const) and not stored.value and not _is_up(world, name)
    if is_down:
        world.held = tuple(held for held in world.held if held != name + FLAG)


def _is_up(world: ConcurrentWorld, name: str) -> bool:
    """Whether the test finds it up now; one for ``None`` takes every other value for that."""
    stored = world.reading.stored
    states = _states_found(world, name)
    if states:
        return _is_up_for(stored, states[-1])
    if stored is None or NONE in options_of(stored):
        return False
    found = (
        world.reading.found.get(step, {}).get(name) for step in world.reading.behind(world.path)
    )
    return FOUND_NONE in found or not isinstance(stored, Const) or bool(stored.value)


def _states_found(world: ConcurrentWorld, name: str) -> list[str]:
    """What tests on the path have found it to be, or not to be, of constants."""
    found = (world.reading.found.get(step, {}).get(name, '') for step in world.path)
    return [each for each in found if each.startswith((FOUND_THIS, FOUND_OTHER))]


def _is_up_for(stored: Value | None, found: str) -> bool:
    """Whether code that finds so by a test does not find it when ``stored`` is there."""
    texts = [text_of(option) for option in options_of(stored)] if stored is not None else [None]
    if found.startswith(FOUND_THIS):
        return None not in texts and found.removeprefix(FOUND_THIS) not in texts
    return all(text == found.removeprefix(FOUND_OTHER) for text in texts)


def after_block(before: tuple[str, ...], now: tuple[str, ...]) -> tuple[str, ...]:
    """What is held after a ``with``: its locks are given back, and flags stay as they are."""
    kept = [held for held in before if not held.endswith(FLAG) or held in now]
    return (*kept, *(held for held in now if held.endswith(FLAG) and held not in kept))


def leave(world: ConcurrentWorld, frame: Frame, *, goes_on: bool) -> None:
    """A function ends: a flag that it holds on some ways out only is not held for certain."""
    ways = [held for held, _, _ in frame.left]
    world.held = _by_all(world.held, ways)
    accepting = [(held, down) for held, down, refuses in frame.left if not refuses]
    accepting += [(world.held, _found_down(world))] if goes_on else []
    helds = [held for held, _ in accepting]
    world.accepted = _by_all(helds[0], helds) if accepting else ()
    downs = [down for _, down in accepting]
    world.found_down = downs[0].intersection(*downs) if downs else frozenset()


def _found_down(world: ConcurrentWorld) -> frozenset[str]:
    reading = world.reading
    known = (reading.down.get(step, ()) for step in reading.behind(world.path))
    return frozenset(flag for flags in known for flag in flags)


def _by_all(held: tuple[str, ...], ways: Iterable[tuple[str, ...]]) -> tuple[str, ...]:
    ways = tuple(ways)
    return tuple(
        lock for lock in held if not lock.endswith(FLAG) or all(lock in way for way in ways)
    )


def note_return(
    world: ConcurrentWorld, frame: Frame, node: ast.Return, found: Iterable[str]
) -> None:
    """One way out of a function, and whether it turns a goal down; ``found`` was read for it."""
    refuses = _refuses(node.value)
    if refuses or (isinstance(node.value, ast.IfExp) and _may_refuse(node.value)):
        world.reading.refuse(world.path, () if refuses else found)
    frame.left.append((world.held, _found_down(world), refuses))


def _refuses(value: ast.expr | None) -> bool:
    return isinstance(value, ast.Attribute) and value.attr == _REFUSING


def _may_refuse(value: ast.IfExp) -> bool:
    return _refuses(value.body) or _refuses(value.orelse)
