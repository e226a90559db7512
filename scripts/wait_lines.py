"""
Why a line that a text search finds is no wait that ``silent-waits`` asks about.

Everything here is asked of the text alone, and of nothing that ros2cc-extract does.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

NO_NODE = 'in files that import no rclpy, or make nothing that has a callback and spin nothing'
TEST = 'in tests'
NO_CALL = 'no call at all: a string, a comment'
NO_WAIT = 'calls that do not block'
WITH_LIMIT = 'with a time-out'
WORKS = 'loops that work in each round'
OWN = 'calls of functions of the program, whose own lines are searched'
UNCALLED = 'in functions that nobody calls, by their names'

_FUTURES = frozenset({'asyncio', 'concurrent', 'multiprocessing'})
_TESTING = frozenset({'pytest', 'unittest', 'launch_testing'})
_ROS = re.compile(
    r'create_(subscription|timer|service|client|guard_condition|rate)|'
    r'Action(Server|Client)|spin|add_node'
)
_LIMITS = re.compile(r'^(timeout\w*|time_to_wait|timeoutMs|max_wait\w*)$')
_CLOCKS = frozenset({'time', 'monotonic', 'perf_counter', 'now', 'to_sec'})
_LIMIT_FIRST = frozenset({'wait', 'join', 'wait_for_service', 'wait_for_server', 'result'})
_LIMIT_SECOND = frozenset({'call', 'wait_for', 'run_coroutine_threadsafe'})
_PLAIN = frozenset({'wait', 'join', 'get', 'put', 'result', 'acquire', 'run'})
_PAUSES = frozenset({'sleep', 'spin_once', 'spin_some', 'wait', 'wait_for_service'})
_CALLED_BY_OTHERS = re.compile(
    r'__\w+__|main|run|execute|handle|setup|update|initialise|terminate|destroy_node|'
    r'(on|do|test)_\w+'
)

Function = ast.FunctionDef | ast.AsyncFunctionDef


class Text:
    """One file."""

    def __init__(self, file: Path) -> None:
        self.text = file.read_text(encoding='utf-8', errors='replace')
        try:
            self.tree = ast.parse(self.text)
        except (SyntaxError, ValueError):
            self.tree = ast.Module(body=[], type_ignores=[])
        self.parts = list(ast.walk(self.tree))
        self.imported = frozenset(_imported(self.parts))
        self.functions = [part for part in self.parts if isinstance(part, Function)]

    @property
    def is_read(self) -> bool:
        """Whether it is Python that this version can read."""
        return bool(self.tree.body)


class Program:
    """All files below one path."""

    def __init__(self, files: Sequence[Path]) -> None:
        self.texts: Mapping[Path, Text] = {file: Text(file) for file in files}
        self._live = _live(self.texts.values())

    def reason(self, file: Path, line: int) -> str | None:
        """Why that line is left out; ``None`` where it may be a wait without an end."""
        text = self.texts[file]
        if not text.is_read:
            return None
        if 'rclpy' not in text.imported or not _ROS.search(text.text):
            return NO_NODE
        if text.imported & _TESTING or file.name == 'conftest.py':
            return TEST
        around = _around(text, line)
        if around and not any(_is_live(each, self._live) for each in around):
            return UNCALLED
        return _reason_in_text(text, line, around)


def _imported(parts: Sequence[ast.AST]) -> Iterator[str]:
    for part in parts:
        if isinstance(part, ast.Import):
            yield from (alias.name.partition('.')[0] for alias in part.names)
        elif isinstance(part, ast.ImportFrom):
            yield (part.module or '').partition('.')[0]


def _around(text: Text, line: int) -> list[Function]:
    """The functions around a line, the innermost last."""
    return [f for f in text.functions if f.lineno <= line <= (f.end_lineno or f.lineno)]


def _is_live(function: Function, live: frozenset[str]) -> bool:
    return function.name in live or _CALLED_BY_OTHERS.fullmatch(function.name) is not None


def _live(texts: Iterable[Text]) -> frozenset[str]:
    """The names that code mentions which somebody may run, from the files' own statements on."""
    bodies: dict[str, list[Function]] = {}
    names: set[str] = set()
    waiting: list[ast.AST] = []
    for text in texts:
        for function in text.functions:
            bodies.setdefault(function.name, []).append(function)
        waiting.append(text.tree)
    started = {name for name in bodies if _CALLED_BY_OTHERS.fullmatch(name)}
    for name in started:
        waiting += bodies.pop(name)
    while waiting:
        for name in _mentioned(waiting.pop()):
            names.add(name)
            waiting += bodies.pop(name, [])
    return frozenset(names)


def _mentioned(node: ast.AST) -> Iterator[str]:
    """Names in the text of ``node``, but for the bodies of functions in it."""
    waiting = list(ast.iter_child_nodes(node))
    while waiting:
        part = waiting.pop()
        if isinstance(part, ast.Name):
            yield part.id
        elif isinstance(part, ast.Attribute):
            yield part.attr
        if isinstance(part, Function):
            if part.decorator_list:
                yield part.name
            waiting += [*part.decorator_list, *part.args.defaults]
        else:
            waiting += ast.iter_child_nodes(part)


def _reason_in_text(text: Text, line: int, around: Sequence[Function]) -> str | None:
    found = [part for part in text.parts if getattr(part, 'lineno', 0) == line]
    loops = [part for part in found if isinstance(part, ast.While)]
    calls = [part for part in found if isinstance(part, ast.Call) and _may_block(part)]
    calls += [c for c in _ending_at(text, line) if c not in calls and _may_block(c)]
    reasons = [_of_loop(loop) for loop in loops]
    reasons += [
        _of_call(call, text, around) for call in calls if not _is_in_loop_test(call, loops)
    ]
    if not reasons:
        return NO_CALL
    return None if None in reasons else reasons[0]


def _ending_at(text: Text, line: int) -> list[ast.Call]:
    """Calls of methods over several lines, whose name stands in the last."""
    return [
        part
        for part in text.parts
        if isinstance(part, ast.Call)
        and isinstance(part.func, ast.Attribute)
        and part.func.end_lineno == line
    ]


def _is_in_loop_test(call: ast.Call, loops: Sequence[ast.While]) -> bool:
    return any(call is part for loop in loops for part in ast.walk(loop.test))


BLOCKING_NAMES = re.compile(
    r'wait(_for(_\w+)?)?|join|acquire|result|communicate|sleep_for|sleep_until|get|put|call|'
    r'send_goal|recv(from)?|accept|run_coroutine_threadsafe|run_until_complete|run|'
    r'check_output|check_call|input|sleep'
)


def _name(call: ast.Call) -> str:
    function = call.func
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, 'id', '')


def _may_block(call: ast.Call) -> bool:
    return BLOCKING_NAMES.fullmatch(_name(call)) is not None


def _of_loop(loop: ast.While) -> str | None:
    called = {_name(part) for part in ast.walk(loop.test) if isinstance(part, ast.Call)}
    has_order = any(
        isinstance(op, (ast.Lt, ast.LtE, ast.Gt, ast.GtE))
        for part in ast.walk(loop.test)
        if isinstance(part, ast.Compare)
        for op in part.ops
    )
    if called & _CLOCKS or has_order:
        return WITH_LIMIT
    inside = {_name(p) for each in loop.body for p in ast.walk(each) if isinstance(p, ast.Call)}
    inside -= {'info', 'warn', 'warning', 'debug', 'error', 'print', 'get_logger'}
    is_pause = not inside or bool(inside & _PAUSES) or 'wait_for_service' in called
    return None if is_pause else WORKS


def _of_call(call: ast.Call, text: Text, around: Sequence[Function]) -> str | None:
    name = _name(call)
    if _has_limit(call, name) or _is_of_socket_with_limit(call, name, text):
        return WITH_LIMIT
    if _is_no_wait(call, name, text, around):
        return NO_WAIT
    if name == 'run_until_complete' and call.args and isinstance(call.args[0], ast.Call):
        name = _name(call.args[0])
    own = {function.name for function in text.functions}
    # A function that wraps one of the same name calls that, and not itself.
    own -= {*_PLAIN, *(function.name for function in around)}
    return OWN if name in own else None


def _has_limit(call: ast.Call, name: str) -> bool:
    given = {keyword.arg or '': keyword.value for keyword in call.keywords}
    limits = [value for key, value in given.items() if _LIMITS.match(key)]
    if name in _LIMIT_FIRST:
        limits += call.args[:1]
    elif name in _LIMIT_SECOND:
        limits += call.args[1:2]
    return any(not (isinstance(v, ast.Constant) and v.value is None) for v in limits)


def _is_of_socket_with_limit(call: ast.Call, name: str, text: Text) -> bool:
    """Whether the file gives a limit to the socket of that name."""
    if not name.startswith('recv') or not isinstance(call.func, ast.Attribute):
        return False
    socket = ast.unparse(call.func.value)
    setters = (part.func for part in text.parts if isinstance(part, ast.Call) and part.args)
    return any(
        isinstance(setter, ast.Attribute)
        and setter.attr in ('settimeout', 'setblocking')
        and ast.unparse(setter.value) == socket
        for setter in setters
    )


def _is_no_wait(call: ast.Call, name: str, text: Text, around: Sequence[Function]) -> bool:
    owner = call.func.value if isinstance(call.func, ast.Attribute) else None
    flags = [k.value for k in call.keywords if k.arg in ('block', 'blocking')]
    if any(isinstance(flag, ast.Constant) and flag.value is False for flag in flags):
        return True
    if name == 'result':
        # ``rclpy.task.Future.result`` returns at once (rclpy 7.1.6, ``task.py``).
        is_known = owner is not None and _is_of_rclpy(owner, text)
        return not text.imported & _FUTURES or is_known or _is_done(owner, text, around)
    if name == 'put':
        return owner is not None and _is_boundless(owner, text)
    if name == 'get':  # of a dictionary
        texts = (arg.value for arg in call.args if isinstance(arg, ast.Constant))
        is_key = bool(call.args) and not isinstance(call.args[0], (ast.Constant, ast.Name))
        return is_key or any(isinstance(text, str) for text in texts)
    if name == 'accept':  # that of sockets takes nothing
        return bool(call.args or call.keywords)
    if name == 'run':
        return owner is None or ast.unparse(owner) != 'subprocess'
    if name == 'input':
        return owner is not None
    return name == 'sleep' and (owner is None or 'rate' not in ast.unparse(owner))


def _is_done(owner: ast.expr | None, text: Text, around: Sequence[Function]) -> bool:
    """Whether it is the argument of a function that done-callbacks are made of."""
    arguments = {arg.arg for function in around for arg in function.args.args}
    if not isinstance(owner, ast.Name) or owner.id not in arguments:
        return False
    given = {
        part
        for call in text.parts
        if isinstance(call, ast.Call) and _name(call) == 'add_done_callback'
        for arg in call.args
        for part in _mentioned(ast.Expression(arg))
    }
    return any(function.name in given for function in around)


def _is_of_rclpy(owner: ast.expr, text: Text) -> bool:
    """Whether clients of rclpy make all that is stored under that name: ``call_async``."""
    made = _made_as(owner, text)
    calls = [each for each in made if not isinstance(each, ast.Constant)]
    return bool(calls) and all(
        isinstance(each, ast.Call) and _name(each).endswith('_async') for each in calls
    )


def _made_as(owner: ast.expr, text: Text) -> list[ast.expr | None]:
    """What is stored in the file where things have the last name of ``owner``."""
    name = ast.unparse(owner).rpartition('.')[2]
    return [
        part.value
        for part in text.parts
        if isinstance(part, (ast.Assign, ast.AnnAssign))
        for target in (part.targets if isinstance(part, ast.Assign) else [part.target])
        if ast.unparse(target).rpartition('.')[2] == name
    ]


def _is_boundless(owner: ast.expr, text: Text) -> bool:
    """Whether the queue is made without a size, wherever a thing of that name is made."""
    calls = [value for value in _made_as(owner, text) if isinstance(value, ast.Call)]
    return bool(calls) and all(
        _name(each) in ('Queue', 'SimpleQueue', 'LifoQueue', 'PriorityQueue')
        and not each.args
        and not each.keywords
        for each in calls
    )
