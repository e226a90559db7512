"""Whether a piece of text has to do with ROS, asked before it is followed."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.program.text_queries import noted_on, walk

MAKING = tuple(
    f'create_{kind}'
    for kind in ('subscription', 'timer', 'service', 'client', 'guard_condition', 'rate')
)
"""Methods of a node that make entities."""


MAKING_NAMES = frozenset(
    [
        'create_subscription',
        'create_timer',
        'create_service',
        'create_client',
        'create_guard_condition',
        'create_rate',
        'create_node',
        'ActionServer',
        'ActionClient',
        'TransformListener',
        'Subscriber',
        'TimeSynchronizer',
        'ApproximateTimeSynchronizer',
        'Updater',
        'Node',
        'LifecycleNode',
        'add_done_callback',
        'create_task',
        'spin',
        'spin_once',
        'spin_until_future_complete',
        'add_node',
        'send_goal',
        'send_goal_async',
        'registerCallback',
        'create_publisher',
    ]
)
"""What makes or serves an entity is called so."""


def creates_entities(node: ast.AST) -> bool:
    """Whether ``node`` names anything that makes or serves an entity."""
    return noted_on(node, 'creates_entities', _creates_entities)


def _creates_entities(node: ast.AST) -> bool:
    return any(
        (part.__class__ is ast.Attribute and part.attr in MAKING_NAMES)
        or (part.__class__ is ast.Name and part.id in MAKING_NAMES)
        for part in walk(node)
    )


_WAITS = frozenset(
    [
        'accept',
        'call',
        'call_async',
        'communicate',
        'get_result',
        'get_result_async',
        'recv',
        'recvfrom',
        'wait',
    ]
)
_WAIT = 'wait_'
_LATER = frozenset(['call_async', 'get_result_async'])
_MAY_WAIT = frozenset(
    ['acquire', 'as_completed', 'run_until_complete', 'sleep_for', 'sleep_until']
)
# With other arguments they are methods of dictionaries.
_WITHOUT_VALUES = frozenset(['get', 'result', 'exception'])
_LIMITS = frozenset(['block', 'timeout'])
_PAUSES = frozenset(['sleep', 'spin_once'])
_OF_PROCESSES = frozenset(['run', 'check_call', 'check_output'])


def waits_for_others(node: ast.AST) -> bool:
    """Whether ``node`` calls something by the name of a wait for other code."""
    return noted_on(node, 'waits_for_others', _waits_for_others)


def _waits_for_others(node: ast.AST) -> bool:
    return any(part.__class__ is ast.Call and _is_wait(part) for part in walk(node))


def _is_wait(call: ast.Call) -> bool:
    function = call.func
    if not isinstance(function, ast.Attribute):
        return isinstance(function, ast.Name) and function.id == 'input'
    if function.attr in _OF_PROCESSES:
        return isinstance(function.value, ast.Name) and function.value.id == 'subprocess'
    is_of_thread = function.attr == 'join' and not call.args  # that of a text takes something
    return function.attr in _WAITS or function.attr.startswith(_WAIT) or is_of_thread


def holds_thread(node: ast.AST) -> bool:
    """Whether ``node`` may wait and keeps its thread meanwhile, by the names of what it calls."""
    return may_wait(node) or noted_on(node, 'holds_thread', _holds_thread)


def _holds_thread(node: ast.AST) -> bool:
    calls = (part for part in walk(node) if part.__class__ is ast.Call)
    return any(_is_wait(call) and getattr(call.func, 'attr', '') not in _LATER for call in calls)


def may_wait(node: ast.AST) -> bool:
    """Whether ``node`` polls data, or calls by a name that is not only that of a wait."""
    return noted_on(node, 'may_wait', _may_wait)


def _may_wait(node: ast.AST) -> bool:
    return any(
        (part.__class__ is ast.Call and _is_perhaps_a_wait(part))
        or (part.__class__ is ast.While and _polls(part))
        for part in walk(node)
    )


def _is_perhaps_a_wait(call: ast.Call) -> bool:
    name = call.func.attr if isinstance(call.func, ast.Attribute) else ''
    if name in _WITHOUT_VALUES:
        is_plain = not call.args or getattr(call.args[0], 'value', None) is True
        return is_plain and all(each.arg in _LIMITS for each in call.keywords)
    return name in _MAY_WAIT or (name == 'put' and len(call.args) == 1)


def _polls(loop: ast.While) -> bool:
    """``while not self.done: time.sleep(0.1)``: it looks again and again, and does little."""
    if isinstance(loop.test, ast.Constant):
        return False
    called = (part.func for part in walk(loop) if isinstance(part, ast.Call))
    names = {getattr(each, 'attr', getattr(each, 'id', '')) for each in called}
    return not _PAUSES.isdisjoint(names) or all(isinstance(part, ast.Pass) for part in loop.body)


def replaces_rclpy(tree: ast.Module) -> bool:
    """Whether a file does not import rclpy but puts a stand-in for it into ``sys.modules``."""
    parts = list(walk(tree))
    touches = any(
        isinstance(part, ast.Attribute)
        and part.attr == 'modules'
        and isinstance(part.value, ast.Name)
        and part.value.id == 'sys'
        for part in parts
    )
    if not touches or any(_imports_rclpy(part) for part in parts):
        return False
    return any(isinstance(part, ast.Constant) and part.value == 'rclpy' for part in parts)


def _imports_rclpy(part: ast.AST) -> bool:
    if isinstance(part, ast.ImportFrom):
        return not part.level and (part.module or '').partition('.')[0] == 'rclpy'
    return isinstance(part, ast.Import) and any(
        alias.name.partition('.')[0] == 'rclpy' for alias in part.names
    )
