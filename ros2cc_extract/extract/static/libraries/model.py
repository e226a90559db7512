"""
Every library class and function with a known effect: one row in one of the tables.

To add an API: a row in the table of its library, and a case in ``tests/scanner_cases``.
"""

from __future__ import annotations

from functools import lru_cache

from ros2cc_extract.extract.static.libraries.rclpy.tables import (
    actions,
    async_nodes,
    called_by_services,
    clients,
    clocks,
    entity_makers,
    events,
    executors,
    groups,
    nodes,
    shutdown,
    spinning_helpers,
    spins,
)
from ros2cc_extract.extract.static.libraries.standard import (
    asyncio_loops,
    futures,
    outside_calls,
    queues,
    servers,
    threads,
)
from ros2cc_extract.extract.static.python.builtins import builtin_functions
from ros2cc_extract.extract.static.python.machine.library_table import Library, merged

_BY_LAST_NAME = frozenset(
    [
        'Node',
        'LifecycleNode',
        'SingleThreadedExecutor',
        'MultiThreadedExecutor',
        'EventsExecutor',
        'Executor',
        'MutuallyExclusiveCallbackGroup',
        'ReentrantCallbackGroup',
        'CallbackGroup',
        'ActionServer',
        'ActionClient',
    ]
)


@lru_cache(maxsize=1)
def table() -> Library:
    """All tables as one."""
    return merged(
        [
            builtin_functions.TABLE,
            threads.TABLE,
            futures.TABLE,
            asyncio_loops.TABLE,
            servers.TABLE,
            queues.TABLE,
            outside_calls.TABLE,
            groups.TABLE,
            clocks.TABLE,
            nodes.TABLE,
            executors.TABLE,
            spins.TABLE,
            clients.TABLE,
            actions.TABLE,
            entity_makers.TABLE,
            spinning_helpers.TABLE,
            events.TABLE,
            called_by_services.TABLE,
            shutdown.TABLE,
            async_nodes.TABLE,
        ]
    )


@lru_cache(maxsize=4096)
def with_bases(name: str) -> tuple[str, ...]:
    """A library class and its bases, as they stand in the tables, nearest first."""
    classes, found, waiting = table().classes, [], [canonical(name)]
    while waiting:
        known = waiting.pop(0)
        if known in classes:
            found.append(known)
            waiting.extend(classes[known].bases)
    return tuple(found)


@lru_cache(maxsize=4096)
def canonical(name: str) -> str:
    """The one name under which ``name`` stands in the tables."""
    whole = table()
    name = whole.aliases.get(name, name)
    if name in whole.classes or name in whole.functions or not name.startswith('rclpy.'):
        return name
    last = name.rpartition('.')[2]
    if last in _BY_LAST_NAME:
        return _by_last_name().get(last, name)
    return name


@lru_cache(maxsize=1)
def _by_last_name() -> dict[str, str]:
    whole = table()
    found = {name.rpartition('.')[2]: name for name in whole.classes if name.startswith('rclpy.')}
    found['Node'] = nodes.NODE
    return found
