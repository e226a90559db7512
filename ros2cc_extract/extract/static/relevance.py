"""Cheap questions about a piece of text, asked before it is followed."""

from __future__ import annotations

import ast
from collections.abc import Iterator

MAKING = tuple(
    f'create_{kind}'
    for kind in ('subscription', 'timer', 'service', 'client', 'guard_condition', 'rate')
)
"""Methods of a node that make entities."""

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
        'spin_until_future_complete',
        'add_node',
        'send_goal',
        'send_goal_async',
        'registerCallback',
        'create_publisher',
    ]
)

CHANGING_METHODS = frozenset(
    {
        'append',
        'appendleft',
        'add',
        'clear',
        'discard',
        'extend',
        'extendleft',
        'insert',
        'pop',
        'popitem',
        'popleft',
        'remove',
        'reverse',
        'setdefault',
        'sort',
        'update',
    }
)
"""Methods of Python's collections that change their owner in place."""

_CACHE: dict[int, tuple[ast.AST, bool]] = {}


def creates_entities(node: ast.AST) -> bool:
    """Whether ``node`` names anything that makes or serves an entity."""
    known = _CACHE.get(id(node))
    if known is not None and known[0] is node:
        return known[1]
    answer = any(
        (isinstance(part, ast.Attribute) and part.attr in _NAMES)
        or (isinstance(part, ast.Name) and part.id in _NAMES)
        for part in walk(node)
    )
    _CACHE[id(node)] = (node, answer)
    return answer


def changed_globals(tree: ast.Module) -> frozenset[str]:
    """Names that the module declares global somewhere, or changes in place."""
    return frozenset(name for part in walk(tree) for name in _changed_names(part))


def walk(node: ast.AST) -> Iterator[ast.AST]:
    """Every node below ``node``, in no particular order; twice as fast as ``ast.walk``."""
    waiting = [node]
    while waiting:
        part = waiting.pop()
        yield part
        for name in part._fields:
            value = getattr(part, name, None)
            if value.__class__ is list:
                waiting.extend(item for item in value if isinstance(item, ast.AST))
            elif isinstance(value, ast.AST):
                waiting.append(value)


def _changed_names(part: ast.AST) -> list[str]:
    if isinstance(part, ast.Global):
        return part.names
    if isinstance(part, ast.Subscript) and isinstance(part.ctx, (ast.Store, ast.Del)):
        return [part.value.id] if isinstance(part.value, ast.Name) else []
    if isinstance(part, ast.Attribute) and part.attr in CHANGING_METHODS:
        return [part.value.id] if isinstance(part.value, ast.Name) else []
    return []


def mangled(name: str, cls: str | None) -> str:
    """The attribute that ``name`` means in the text of class ``cls``: private ones are its own."""
    if cls is None or not name.startswith('__') or name.endswith('__'):
        return name
    return f'_{cls.lstrip("_")}{name}'


def unmangled(name: str, cls: str) -> str:
    """How the text of class ``cls`` calls its attribute ``name``."""
    prefix = f'_{cls.lstrip("_")}'
    return name.removeprefix(prefix) if name.startswith(f'{prefix}__') else name


_REASSIGNED: dict[int, tuple[ast.AST, frozenset[str]]] = {}


def reassigned_attributes(cls: ast.ClassDef) -> frozenset[str]:
    """Attributes of ``self`` that a method other than ``__init__`` assigns; see ``mangled``."""
    known = _REASSIGNED.get(id(cls))
    if known is not None and known[0] is cls:
        return known[1]
    names = frozenset(
        mangled(part.attr, cls.name)
        for method in cls.body
        if isinstance(method, (ast.FunctionDef, ast.AsyncFunctionDef))
        and method.name != '__init__'
        for part in walk(method)
        if isinstance(part, ast.Attribute) and isinstance(part.ctx, ast.Store)
    )
    _REASSIGNED[id(cls)] = (cls, names)
    return names
