"""
How many callbacks an executor can run at once, as far as that is known.

Source: rclpy 7.1.6 and 9.1.2, ``executors.py`` (``SingleThreadedExecutor``,
``MultiThreadedExecutor``) and ``experimental/events_executor.py``; 10.0.10 and 11.0.0,
``experimental/async_node.py``.
"""

from __future__ import annotations

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Executor

SINGLE = 'SingleThreadedExecutor'
MULTI = 'MultiThreadedExecutor'
EVENTS = 'EventsExecutor'
ASYNCIO = 'AsyncNode'
"""The loop of asyncio that runs such nodes."""
DEFAULT_COUNT = 'default_cpu_count'


@dataclass(frozen=True)
class Workers:
    """
    The threads that run callbacks.

    :param is_default: the number is that of the CPUs at run time; ``count`` is only assumed.
    """

    count: int
    is_default: bool = False


def workers_of(executor: Executor) -> Workers | Unknown:
    """The threads of ``executor``, or why they are not known."""
    kind = executor.kind
    if isinstance(kind, Unknown):
        return kind
    if executor.unresolved is not None:
        return executor.unresolved
    if kind in (SINGLE, EVENTS, ASYNCIO):
        return Workers(1)
    if kind in (None, MULTI) or executor.assumed:
        return Workers(len(executor.threads), executor.threads_source == DEFAULT_COUNT)
    return Unknown(f'custom executor class {kind}', executor.source)


def is_one_thread(executor: Executor) -> bool:
    """True when it is certain that callbacks run one after the other on one thread."""
    return workers_of(executor) == Workers(1)


def runs_in_parallel(executor: Executor) -> bool:
    """True when callbacks run on several threads; a default count is taken for several."""
    workers = workers_of(executor)
    return isinstance(workers, Workers) and (workers.count > 1 or workers.is_default)


def honours_groups(executor: Executor) -> bool:
    """False for the one executor that never asks the callback groups."""
    return executor.kind != EVENTS
