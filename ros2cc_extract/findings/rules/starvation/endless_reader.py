"""CC207: a subscription of an ``AsyncNode`` that feeds itself; found by the extractor."""

from __future__ import annotations

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Rule

RULE = Rule(
    code='CC207',
    slug='endless-reader',
    severity=Severity.WARNING,
    title='Subscription that never gives way to the loop',
    what='The callback of a subscription of an `AsyncNode` awaits nothing and publishes, in every '
    'run, on the topic that it is subscribed to. Timers, services, clients and the rest of the '
    'program never run again.',
    why='The task of a subscription takes one message after the other and gives way to the loop '
    'only where the callback awaits, or where there is no message. The next message is there '
    'before the callback has ended. Sources: rclpy 10.0.10 and 11.0.0, '
    '`experimental/async_subscription.py` (`_messages`, `_run`). Observed on both: a timer beside '
    'it, and the program, stand still. An executor serves others in between.',
    bad="""\
class Echo(AsyncNode):
    def __init__(self):
        super().__init__('echo')
        self.pub = self.create_publisher(Empty, 'beat', 10)
        self.create_subscription(Empty, 'beat', self.on_beat, 10)

    def on_beat(self, msg):
        self.pub.publish(Empty())
""",
    good="""\
class Echo(AsyncNode):
    def __init__(self):
        super().__init__('echo')
        self.pub = self.create_publisher(Empty, 'beat', 10)
        self.create_subscription(Empty, 'beat', self.on_beat, 10)

    async def on_beat(self, msg):
        await asyncio.sleep(0.1)
        self.pub.publish(Empty())
""",
    mend='Await something between two messages, or publish from a timer.',
)
