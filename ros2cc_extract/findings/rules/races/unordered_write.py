"""CC302: an attribute assigned by callbacks that may overlap."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.races.races import RaceKind, races_of
from ros2cc_extract.findings.rules.races.lost_update import hit_of


def find(context: Context) -> Iterator[Hit]:
    for race in races_of(context):
        if race.kind is RaceKind.LAST_WRITE_WINS:
            yield hit_of(race)


RULE = Rule(
    code='CC302',
    slug='unordered-write',
    severity=Severity.NOTE,
    title='Attribute assigned by callbacks that may overlap',
    what='Two callbacks that may run at the same time assign the same attribute, and neither '
    'reads it; threads that the program starts count like callbacks. Nothing breaks by itself, '
    'but which value remains is a matter of chance. A note.',
    why='A single assignment is atomic in CPython, so no value is torn; but several attributes '
    'that belong together are not written together. Source: rclpy 7.1.6 and 9.1.2, '
    '`executors.py` (`MultiThreadedExecutor`), `callback_groups.py`.',
    bad="""\
class Arm(Node):
    def on_start(self, msg):
        self.state = 'driving'

    def on_stop(self, msg):      # in another group
        self.state = 'stopped'
""",
    good="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        commands = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Empty, 'start', self.on_start, 10, callback_group=commands)
        self.create_subscription(Empty, 'stop', self.on_stop, 10, callback_group=commands)
""",
    mend='If the order matters, put both callbacks into one mutually exclusive group.',
    find=find,
)
