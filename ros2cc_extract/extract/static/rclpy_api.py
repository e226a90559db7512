"""
Every library class and function with a known effect: one row in one of the tables.

To add an API: a row in the table of its library, and a case in ``tests/scanner_cases``.
"""

from __future__ import annotations

from functools import lru_cache

from ros2cc_extract.extract.static import (
    asyncio_library,
    futures_library,
    outside_library,
    python_library,
    queues_library,
    ros_actions,
    ros_async,
    ros_called,
    ros_clients,
    ros_clocks,
    ros_events,
    ros_executors,
    ros_groups,
    ros_helpers,
    ros_libraries,
    ros_nodes,
    ros_shutdown,
    ros_spins,
    servers_library,
    threads_library,
)
from ros2cc_extract.extract.static.library_table import Library, merged

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
            python_library.TABLE,
            threads_library.TABLE,
            futures_library.TABLE,
            asyncio_library.TABLE,
            servers_library.TABLE,
            queues_library.TABLE,
            outside_library.TABLE,
            ros_groups.TABLE,
            ros_clocks.TABLE,
            ros_nodes.TABLE,
            ros_executors.TABLE,
            ros_spins.TABLE,
            ros_clients.TABLE,
            ros_actions.TABLE,
            ros_libraries.TABLE,
            ros_helpers.TABLE,
            ros_events.TABLE,
            ros_called.TABLE,
            ros_shutdown.TABLE,
            ros_async.TABLE,
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
    found['Node'] = ros_nodes.NODE
    return found
