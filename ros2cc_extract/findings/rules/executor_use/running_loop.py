"""CC127: a callback needs a loop of asyncio, and none runs in its thread; by the extractor."""

from __future__ import annotations

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Rule

RULE = Rule(
    code='CC127',
    slug='no-running-loop',
    severity=Severity.ERROR,
    title='asyncio task in a callback without a running loop',
    what='A callback calls `asyncio.create_task`, `get_running_loop`, `current_task`, or, on a '
    'thread other than the main one, `ensure_future`, `gather` or `get_event_loop`. No asyncio '
    'loop runs in the thread that serves it, so the call raises `RuntimeError` and the spin ends. '
    'On the main thread `ensure_future` raises nothing up to Python 3.13, but nothing runs its '
    'coroutine (a warning).',
    why='An executor of rclpy is no asyncio loop, and runs callbacks, coroutines too, outside of '
    'any. A loop runs there only if a coroutine of asyncio itself calls `spin_once`. Nothing is '
    'reported where the callback catches the error, or asks `is_running()`. Sources: Python 3.12, '
    '`asyncio/events.py`; rclpy 7.1.6 and 9.1.2, `task.py` (`Task.__call__`). Measured on both: '
    'the first such call ends `rclpy.spin`.',
    bad="""\
class Uploader(Node):
    def on_picture(self, msg):               # of a subscription
        asyncio.create_task(self.upload(msg))
""",
    good="""\
class Uploader(Node):
    def __init__(self):
        super().__init__('uploader')
        self.loop = asyncio.new_event_loop()
        threading.Thread(target=self.loop.run_forever, daemon=True).start()
        self.create_subscription(Image, 'picture', self.on_picture, 10)

    def on_picture(self, msg):
        asyncio.run_coroutine_threadsafe(self.upload(msg), self.loop)
""",
    mend='Run a loop in a thread of its own, and hand the coroutine over by '
    '`asyncio.run_coroutine_threadsafe(coroutine, loop)`.',
)
