"""CC123: a coroutine, a task or an answer that is lost; found by the extractor."""

from __future__ import annotations

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Rule

RULE = Rule(
    code='CC123',
    slug='lost-task',
    severity=Severity.WARNING,
    title='Coroutine, task or answer that is lost',
    what='A coroutine function is called and its result is dropped, so that none of its code '
    'runs. Or a callback of an `AsyncNode`, or the program beside it, starts a task by '
    '`asyncio.create_task` or `asyncio.ensure_future` and keeps it nowhere: an exception in the '
    'task ends nothing and is reported at some later time, and the garbage collector may destroy '
    'the task while it waits. Or a callback on the main thread gives a coroutine to '
    '`asyncio.ensure_future`, and no loop runs there. Or a callback sends a request and asks '
    'at once for the `result()` of its future: that is None, as no answer has come.',
    why='Calling a coroutine function only makes a coroutine; `await` or a task runs it. A loop '
    'keeps weak references to its tasks, and a task raises its exception where it is awaited. '
    '`Future.result()` of rclpy does not wait. '
    'Sources: Python 3.12, library reference, "Coroutines and Tasks", `asyncio/tasks.py`. '
    'Observed with rclpy 10.0.10 and 11.0.0: a `call` without `await` sends nothing, a '
    '`ValueError` in a task leaves the `AsyncNode` running, and a task that waited for a future '
    'of its own was gone after `gc.collect()`; rclpy 7.1.6 and 9.1.2, `task.py` (`result`).',
    bad="""\
class Arm(AsyncNode):
    async def on_goal(self, msg):
        asyncio.create_task(self.move(msg))
""",
    good="""\
class Arm(AsyncNode):
    async def on_goal(self, msg):
        async with asyncio.TaskGroup() as tasks:
            tasks.create_task(self.move(msg))
""",
    mend='Await a coroutine. Keep a task and await it, or start it in an `asyncio.TaskGroup`. '
    'Use an answer in a done-callback, or await it.',
)
