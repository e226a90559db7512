"""Whether a piece of text can make ROS entities at all: a cheap question, asked first."""

from __future__ import annotations

import ast

_NAMES = frozenset(
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
    ]
)

_CACHE: dict[int, tuple[ast.AST, bool]] = {}


def creates_entities(node: ast.AST) -> bool:
    """Whether ``node`` names anything that makes or serves an entity."""
    known = _CACHE.get(id(node))
    if known is not None and known[0] is node:
        return known[1]
    answer = any(
        (isinstance(part, ast.Attribute) and part.attr in _NAMES)
        or (isinstance(part, ast.Name) and part.id in _NAMES)
        for part in ast.walk(node)
    )
    _CACHE[id(node)] = (node, answer)
    return answer
