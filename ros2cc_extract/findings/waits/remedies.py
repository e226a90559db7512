"""
What to do instead, by what runs the callbacks.

A loop of asyncio has one thread and no callback groups, so that neither more threads nor other
groups help there. Source: rclpy 10.0.10 and 11.0.0, ``experimental/async_node.py``.
"""

from __future__ import annotations

from ros2cc_extract.findings.waits.workers import ASYNCIO
from ros2cc_extract.spec.model import Executor

_TO_THREAD = 'hand it to a thread by `await asyncio.to_thread(…)`'
AWAIT_IT = f'await it, as an `asyncio.Event` or `asyncio.Queue`, or {_TO_THREAD}'
AWAIT_SLEEP = f'`await asyncio.sleep(…)`, or {_TO_THREAD}'
BE_CONCURRENT = 'create it with `concurrent=True`, or do not await that there'
LOCK_OF_LOOP = 'hold one `asyncio.Lock` around both, or do not await in between'


def is_on_loop(executor: Executor) -> bool:
    """Whether a loop of asyncio runs the callbacks."""
    return executor.kind == ASYNCIO
