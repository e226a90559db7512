"""What the tests that end a loop ask for, by their text."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import (
    CLOCKS,
    is_endless,
    is_idle,
)
from ros2cc_extract.extract.static.program.text_queries import walk

LEAVES = (ast.Break, ast.Return, ast.Raise)

_LETTING = (ast.Yield, ast.YieldFrom, ast.Await)
"""What lets others run."""

_INNER = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)

_NEUTRAL = frozenset(
    [
        'ok',
        'len',
        'bool',
        'any',
        'all',
        'isinstance',
        'hasattr',
        'getattr',
        'set',
        'frozenset',
        'abs',
        'min',
        'max',
        'sum',
        'round',
        'int',
        'float',
        'str',
        'list',
        'tuple',
        'sorted',
        'sqrt',
        'hypot',
        'fabs',
        'dist',
        'norm',
        'isclose',
        'isnan',
        'isfinite',
        'atan2',
    ]
)
"""What says no more than its arguments: of Python, ``math`` and ``numpy``."""

_CHANGED_BY_CLIENTS = frozenset(['is_cancel_requested', 'is_active'])

_OF_SERVICES = frozenset(
    ['wait_for_service', 'wait_for_server', 'service_is_ready', 'server_is_ready']
)

_ASKED = _OF_SERVICES | {'done', 'is_set', 'is_alive'}


def exit_tests(loop: ast.While) -> Iterator[ast.expr]:
    """Tests one of which must come out otherwise for the loop to end."""
    if not is_endless(loop):
        yield loop.test
    for part in leaving_branches(loop):
        yield part.test


def leaving_branches(loop: ast.While) -> Iterator[ast.If]:
    """The branches inside of which one arm leaves the loop."""
    for part in own_parts(loop.body):
        if isinstance(part, ast.If) and any(
            isinstance(each, LEAVES) for arm in (part.body, part.orelse) for each in arm
        ):
            yield part


def lines_that_leave(loop: ast.While) -> frozenset[int]:
    """The lines of the branches behind which there is no other round."""
    arms = (arm for part in leaving_branches(loop) for arm in (part.body, part.orelse))
    left = (arm for arm in arms if arm and isinstance(arm[-1], LEAVES))
    return frozenset(
        line for arm in left for line in range(arm[0].lineno, (arm[-1].end_lineno or 0) + 1)
    )


def only_exit(loop: ast.While) -> ast.expr | None:
    """
    The one test that ends a loop, if there is one: its own that fails, or one inside that holds.

    ``while True: … if self.pose is not None: break`` has one inside.
    """
    if not is_endless(loop):
        return None if leaves(loop) else loop.test
    inside = [part for part in own_parts(loop.body) if isinstance(part, ast.If)]
    left = [part for part in own_parts(loop.body) if isinstance(part, (*LEAVES, *_LETTING))]
    ends = [part for part in inside if any(isinstance(each, LEAVES) for each in part.body)]
    return ends[0].test if len(left) == len(ends) == 1 else None


def leaves(loop: ast.While) -> bool:
    """Whether something in its body leaves it, or lets others run."""
    return any(isinstance(part, (*LEAVES, *_LETTING)) for part in own_parts(loop.body))


def own_parts(body: Sequence[ast.stmt]) -> Iterator[ast.AST]:
    """What stands in the body of a loop, and in no function inside of it."""
    waiting: list[ast.AST] = list(body)
    while waiting:
        part = waiting.pop(0)
        if not isinstance(part, _INNER):
            yield part
            waiting.extend(ast.iter_child_nodes(part))


def names_assigned(part: ast.AST) -> Iterator[str]:
    """The name that is stored to here."""
    if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store):
        yield part.id


def names_grown(part: ast.AST) -> Iterator[str]:
    """Names whose object a method, an assignment to an item, or a receiver may change."""
    if isinstance(part, ast.Call) and name_of(part) not in _NEUTRAL:
        yield from (each.id for each in part.args if isinstance(each, ast.Name))
    target = part.func if isinstance(part, ast.Call) else part
    is_stored = isinstance(part, ast.Subscript) and isinstance(part.ctx, ast.Store)
    if (isinstance(part, ast.Call) or is_stored) and isinstance(
        target, (ast.Attribute, ast.Subscript)
    ):
        owner = target.value
        if isinstance(owner, ast.Name):
            yield owner.id


def owners(test: ast.expr) -> set[str]:
    """Names of which the test reads an attribute: that is shared data, and asked as such."""
    parts = (part.value for part in walk(test) if isinstance(part, ast.Attribute))
    return {owner.id for owner in parts if isinstance(owner, ast.Name)}


def is_neutral(part: ast.expr) -> bool:
    """Whether it calls what changes nothing and says no more than its arguments."""
    return isinstance(part, ast.Call) and name_of(part) in _NEUTRAL


def name_of(call: ast.Call) -> str:
    """The last name of what is called."""
    function = call.func
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, 'id', '')


def asks_object(test: ast.expr) -> bool:
    """Whether a test asks an object; a question by a method is noted elsewhere."""
    return _calls_one_of(test, _ASKED)


def asks_for_service(test: ast.expr) -> bool:
    """Whether others are there is a wait of its own."""
    return _calls_one_of(test, _OF_SERVICES)


def _calls_one_of(test: ast.expr, names: frozenset[str]) -> bool:
    return any(
        isinstance(part, ast.Call)
        and isinstance(part.func, ast.Attribute)
        and part.func.attr in names
        for part in walk(test)
    )


def _counts(loop: ast.While) -> bool:
    return any(
        isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store)
        for each in loop.body
        for part in walk(each)
    )


def only_sleeps(loop: ast.While, tests: list[ast.expr]) -> bool:
    """Whether it only sleeps until the answer to something that no clock changes is different."""
    called = {name_of(part) for test in tests for part in walk(test) if isinstance(part, ast.Call)}
    return is_idle(loop) and called.isdisjoint(CLOCKS) and not _counts(loop)


def tells_time(node: ast.AST) -> bool:
    """Whether a clock is asked."""
    return any(isinstance(part, ast.Call) and name_of(part) in CLOCKS for part in walk(node))


def runs_out(test: ast.expr, loop: ast.While) -> bool:
    """Whether a clock is asked, or what each round of the loop changes."""
    stored = {name for each in loop.body for part in walk(each) for name in names_assigned(part)}
    names = {part.id for part in walk(test) if isinstance(part, ast.Name)}
    return tells_time(test) or not names.isdisjoint(stored)


def asks_for_cancel(test: ast.expr) -> bool:
    """Whether a goal is asked for what its client, another process as a rule, may change."""
    parts = (part for part in walk(test) if isinstance(part, ast.Attribute))
    return any(part.attr in _CHANGED_BY_CLIENTS for part in parts)
