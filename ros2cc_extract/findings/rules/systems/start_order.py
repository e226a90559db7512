"""CC707: processes that wait for each other before any of them offers what it is asked for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Hit, Rule
from ros2cc_extract.findings.base.wording import listing
from ros2cc_extract.spec.system.model import System
from ros2cc_extract.spec.system.start_up import StartWait, start_circles


def find(system: System) -> Iterator[Hit]:
    """One hit for each circle; a warning if unknown code may offer it too."""
    for circle in start_circles(system):
        yield _hit(circle, is_whole=system.is_whole)


def _hit(circle: Sequence[StartWait], *, is_whole: bool) -> Hit:
    names = list(dict.fromkeys(each.process.name for each in circle))
    start = 'starts' if len(names) == 1 else 'start'
    return Hit(
        place=circle[0].awaited.source,
        message=f'{listing(names, 4)} never {start}: {"; ".join(map(_words, circle))}',
        help='make what others ask for before you wait, or wait with a time-out, or once the '
        'node is spun',
        severity=None if is_whole else Severity.WARNING,
        subjects=tuple(names),
        related=tuple(
            Remark(each.awaited.source, f'{each.process.name} waits here for {_name(each)}')
            for each in circle[1:]
        ),
    )


def _words(wait: StartWait) -> str:
    """What it waits for, and why that does not come."""
    other = wait.by[0]
    its = 'it' if other == wait.process.name else other
    does = (
        'answers only once it is spun' if wait.awaited.answers else 'offers only behind its wait'
    )
    return f'{wait.process.name} waits in its set-up for {_name(wait)}, which {its} {does}'


def _name(wait: StartWait) -> str:
    return f'{wait.awaited.what} {wait.awaited.name}'


RULE = Rule(
    code='CC707',
    slug='start-order',
    severity=Severity.ERROR,
    title='Processes that wait for each other before they start',
    what='The set-up of a process (a constructor, or `main` before the spin) waits without a '
    'time-out for a service or action of another process, and that one, in its own set-up, waits '
    'for one of the first. Each offers what the other waits for only behind its own wait. A loop '
    '`while not client.wait_for_service(timeout_sec=1.0)` is a wait without a time-out.',
    why='`wait_for_service` returns when the graph has the service, and the graph has it when the '
    'line that creates it has run. No order of starting helps: both stand in their set-up, '
    'neither is spun, and nothing is logged but that a service is not available. An answer that '
    'the set-up waits for needs the other process to be spun. Source: rclpy 7.1.6, `client.py` '
    '(`wait_for_service` asks the graph and sleeps).',
    bad="""\
self.client = self.create_client(Trigger, 'plan')            # in the process that offers `back`
while not self.client.wait_for_service(timeout_sec=1.0):
    self.get_logger().info('plan is not there yet')
self.create_service(Trigger, 'back', self.on_back)           # and the other one waits for `back`
""",
    good="""\
self.create_service(Trigger, 'back', self.on_back)
self.client = self.create_client(Trigger, 'plan')
while not self.client.wait_for_service(timeout_sec=1.0):
    self.get_logger().info('plan is not there yet')
""",
    mend='Create services and action servers before you wait for those of others.',
)
