"""CC124 and CC126: a callback has a parameter that some releases pass nothing for."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Callback, EntityKind
from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.table import MESSAGE_INFO, TIMER_INFO


def find(
    kind: EntityKind, passes: Behaviour, needs: str, mend: str, context: Context
) -> Iterator[Hit]:
    """Callbacks of a kind; a note where it is open which release runs them."""
    is_passed = passes.holds(context.unit.rclpy)
    for callback in context.written if is_passed is not True else ():
        if callback.takes_info and callback.entity is kind:
            yield _hit(callback, needs, mend, None if is_passed is False else Severity.NOTE)


def _hit(callback: Callback, needs: str, mend: str, severity: Severity | None) -> Hit:
    return Hit(
        place=callback.defined or callback.source or Place(callback.name),
        message=f'{callback.display_name} needs {needs}',
        help=mend,
        severity=severity,
        subjects=(callback.name,),
        related=tuple(made_at(callback)),
    )


OF_MESSAGE = Rule(
    code='CC124',
    slug='message-info',
    severity=Severity.ERROR,
    title='Subscription that needs what Humble does not pass',
    what='The callback of a subscription has a second parameter, for the information of the '
    'message, which Humble does not pass. A note where the release is not known; `--distro '
    'humble` or `--rclpy 3.3.21` sets it.',
    why='Humble (rclpy 3.3) calls a subscription with the message alone, so each message raises '
    '`TypeError` and ends the spin. Sources: rclpy 3.3.21, `executors.py` (`_take_subscription`); '
    '7.1.11, `subscription.py` (`CallbackType`). Measured on 3.3.21, rclpy 7.1.6 and 9.1.2.',
    bad="""\
class Delay(Node):
    def __init__(self):
        super().__init__('delay')
        self.create_subscription(String, 'words', self.on_word, 10)

    def on_word(self, message, info):        # Humble passes no info
        self.delay = info['received_timestamp'] - info['source_timestamp']
""",
    good="""\
class Delay(Node):
    def __init__(self):
        super().__init__('delay')
        self.create_subscription(PointStamped, 'words', self.on_point, 10)

    def on_point(self, message):
        self.delay = self.get_clock().now() - Time.from_msg(message.header.stamp)
""",
    mend='Take the message alone and put what you need into it, or say by `--distro` which '
    'releases run the node.',
    find=partial(
        find,
        EntityKind.SUBSCRIPTION,
        MESSAGE_INFO,
        'the information of the message, which rclpy passes from 4.0 on: on Humble (3.3) each '
        'message raises TypeError',
        'take the message alone, and put what you need into it',
    ),
)
OF_TIMER = Rule(
    code='CC126',
    slug='timer-info',
    severity=Severity.ERROR,
    title='Timer that needs what Humble and Jazzy do not pass',
    what='The callback of a timer has a parameter of type `TimerInfo`, which Humble and Jazzy do '
    'not have. A note where the release is not known; `--distro jazzy` sets it.',
    why='From rclpy 9.0 (Kilted) on a parameter with this annotation gets the expected and the '
    'actual time of the call; before, importing `TimerInfo` raises `ImportError`. Sources: rclpy '
    '9.1.5, `executors.py` (`_take_timer`); 7.1.11, `timer.py`. Measured on 3.3.21, rclpy 7.1.6 '
    'and 9.1.2.',
    bad="""\
class Control(Node):
    def step(self, info: TimerInfo):         # Jazzy has no TimerInfo
        self.late = info.actual_call_time - info.expected_call_time
""",
    good="""\
class Control(Node):
    def step(self):
        now = self.get_clock().now()
        self.since_last, self.last = now - self.last, now
""",
    mend='Read the clock in the callback instead, or say by `--distro` which releases run the '
    'node.',
    find=partial(
        find,
        EntityKind.TIMER,
        TIMER_INFO,
        'a TimerInfo, which rclpy has from 9.0 (Kilted) on: on Humble and Jazzy it cannot be '
        'imported',
        'read the clock in the callback instead',
    ),
)
