"""CC119: another thread touches what belongs to a loop of asyncio; found by the extractor."""

from __future__ import annotations

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Rule

RULE = Rule(
    code='CC119',
    slug='foreign-loop',
    severity=Severity.WARNING,
    title='asyncio object touched by another thread',
    what='A callback, or a thread of the program, puts an item into an `asyncio.Queue`, sets an '
    '`asyncio.Event` or future, or calls `call_soon` or `create_task` of a loop that another '
    'thread runs. The loop does not wake up: the waiting coroutine continues when something else '
    'wakes the loop, or never.',
    why='A loop sleeps until a timer or a file descriptor wakes it. `call_soon_threadsafe` '
    'writes to such a descriptor; `put_nowait`, `set`, `set_result` and `call_soon` do not, and '
    'they take no lock. Sources: Python 3.12, library reference, "Developing with asyncio" '
    '(concurrency and multithreading), `asyncio/base_events.py`. Measured with rclpy 7.1.6 and '
    '9.1.2: nothing leaves the queue.',
    bad="""\
class Bridge(Node):
    def __init__(self, loop, outbox):
        super().__init__('bridge')
        self.loop, self.outbox = loop, outbox        # the loop runs in a thread of its own
        self.create_subscription(String, 'text', self.on_text, 10)

    def on_text(self, msg):
        self.outbox.put_nowait(msg)
""",
    good="""\
class Bridge(Node):
    def on_text(self, msg):
        self.loop.call_soon_threadsafe(self.outbox.put_nowait, msg)
""",
    mend='Hand it to the loop by `loop.call_soon_threadsafe(function, …)`, or a coroutine by '
    '`asyncio.run_coroutine_threadsafe(coroutine, loop)`.',
)
