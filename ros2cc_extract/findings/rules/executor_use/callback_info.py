"""CC124: a callback has a parameter for which some releases pass nothing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Callback, EntityKind
from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.table import MESSAGE_INFO, TIMER_INFO

PASSED_BY: Mapping[EntityKind, Behaviour] = {
    EntityKind.SUBSCRIPTION: MESSAGE_INFO,
    EntityKind.TIMER: TIMER_INFO,
}
_NEEDS = {
    EntityKind.SUBSCRIPTION: 'the information of the message, which rclpy passes from 4.0 on: on '
    'Humble (3.3) each message raises TypeError',
    EntityKind.TIMER: 'a TimerInfo, which rclpy has from 9.0 (Kilted) on: on Humble and Jazzy it '
    'cannot be imported',
}
_MENDS = {
    EntityKind.SUBSCRIPTION: 'take the message alone, or give the second parameter a default',
    EntityKind.TIMER: 'read the clock in the callback instead',
}


def find(context: Context) -> Iterator[Hit]:
    for callback in context.written:
        behaviour = PASSED_BY.get(callback.entity) if callback.entity else None
        passes = behaviour.holds(context.unit.rclpy) if behaviour else True
        if callback.takes_info and not passes:
            yield _hit(callback, None if passes is False else Severity.NOTE)


def _hit(callback: Callback, severity: Severity | None) -> Hit:
    assert callback.entity is not None
    return Hit(
        place=callback.defined or callback.source or Place(callback.name),
        message=f'{callback.display_name} needs {_NEEDS[callback.entity]}',
        help=_MENDS[callback.entity],
        severity=severity,
        subjects=(callback.name,),
        related=tuple(made_at(callback)),
    )


RULE = Rule(
    code='CC124',
    slug='callback-info',
    severity=Severity.ERROR,
    title='Callback argument that the release does not pass',
    what='A callback of a subscription has a second parameter, for the information of the '
    'message, or that of a timer one of type `TimerInfo`. Releases that are older pass nothing '
    'there. A note where the release is not known; `--rclpy 3.3.21` or `--distro humble` sets it.',
    why='Humble (rclpy 3.3) calls a subscription with the message alone, so each message raises '
    '`TypeError` and ends the spin; Humble and Jazzy (3.3, 7.1) have no `TimerInfo`. Sources: '
    'rclpy 3.3.21, 7.1.6 and 9.1.5, `executors.py` (`_take_subscription`, `_take_timer`), '
    '`subscription.py`, `timer.py`. Measured on 3.3.21, 7.1.6 and 9.1.2.',
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
        self.create_subscription(Stamped, 'words', self.on_word, 10)

    def on_word(self, message):
        self.delay = self.get_clock().now() - Time.from_msg(message.header.stamp)
""",
    mend='Take the message alone and put what you need into it, or say by `--distro` which '
    'releases run the node.',
    find=find,
)
