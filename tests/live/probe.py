"""
Oracle of the live tests: run a node and report what its executors really hold.

Used as ``python probe.py FD NODE.py [ARGUMENTS]``: runs NODE.py as the main program and writes to
file descriptor FD one line of JSON for each executor, when it first waits with nodes in it. Runs
inside the node's process, so the standard library and rclpy are all it may use. It shares no code
with the tool: it is what the tool is compared with.
"""

from __future__ import annotations

import functools
import json
import os
import runpy
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.event_handler import EventHandler
from rclpy.executors import Executor, MultiThreadedExecutor
from rclpy.node import Node

KINDS = {
    'timer': 'timers',
    'subscription': 'subscriptions',
    'guard_condition': 'guards',
    'client': 'clients',
    'service': 'services',
}
ACTION_KINDS = {'ActionServer': 'action_server', 'ActionClient': 'action_client'}
GROUP_TYPES = {
    MutuallyExclusiveCallbackGroup: 'EXCLUSIVE',
    ReentrantCallbackGroup: 'REENTRANT',
}


def main() -> None:
    descriptor, program = int(sys.argv[1]), sys.argv[2]
    sys.argv = sys.argv[2:]
    sys.path[0] = str(Path(program).resolve().parent)
    tell_at_first_wait(descriptor)
    runpy.run_path(program, run_name='__main__')


def tell_at_first_wait(descriptor: int) -> None:
    """Make every executor report what it holds before it first waits for work."""
    original = Executor.wait_for_ready_callbacks
    told: list[Executor] = []

    @functools.wraps(original)
    def wait(executor: Executor, *args: Any, **kwargs: Any) -> Any:
        if executor not in told and executor.get_nodes():
            told.append(executor)
            os.write(descriptor, (json.dumps(describe_executor(executor)) + '\n').encode())
        return original(executor, *args, **kwargs)

    Executor.wait_for_ready_callbacks = wait


def describe_executor(executor: Executor) -> dict[str, Any]:
    pooled = isinstance(executor, MultiThreadedExecutor)
    return {
        'kind': type(executor).__name__,
        'threads': executor._executor._max_workers if pooled else 1,
        'entities': [entity for node in executor.get_nodes() for entity in entities(node)],
    }


def entities(node: Node) -> Iterator[dict[str, Any]]:
    """Describe what somebody wrote: not rclpy's own services and event handlers."""
    for kind, attribute in KINDS.items():
        for entity in getattr(node, attribute):
            callback = function_of(entity)
            if not (callback and callback.__module__.startswith('rclpy.')):
                yield describe_entity(node, entity, kind, callback)
    for waitable in node.waitables:
        if not isinstance(waitable, EventHandler):
            kind = ACTION_KINDS.get(type(waitable).__name__, 'waitable')
            callback = getattr(waitable, '_goal_callback', None)
            yield describe_entity(node, waitable, kind, callback)


def describe_entity(node: Node, entity: Any, kind: str, callback: Any) -> dict[str, Any]:
    group = entity.callback_group
    return {
        'node': node.get_name(),
        'entity': kind,
        'callback': callback and callback.__qualname__.rpartition('.')[2],
        'key': key_of(entity, kind),
        'group': id(group),
        'group_type': GROUP_TYPES.get(type(group), type(group).__name__),
        'group_is_default': group is node.default_callback_group,
    }


def function_of(entity: Any) -> Any:
    callback = getattr(entity, 'callback', None)
    while isinstance(callback, functools.partial):
        callback = callback.func
    return callback


def key_of(entity: Any, kind: str) -> str | float | None:
    if kind == 'timer':
        return entity.timer_period_ns / 1e9
    names = (getattr(entity, name, None) for name in ('topic', 'srv_name', '_action_name'))
    return next((name for name in names if name is not None), None)


if __name__ == '__main__':
    main()
