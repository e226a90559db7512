"""CC303: a race with work that is in no group, though it seems to be."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import shown
from ros2cc_extract.findings.races.goal_admission import LateClaim, late_claims
from ros2cc_extract.findings.races.races import Race, races_of
from ros2cc_extract.findings.rules.races.lost_update import OF_OTHER_RULES, hit_of
from ros2cc_extract.spec.model import Callback, EntityKind

_WHAT = {
    EntityKind.ACTION_EXECUTE: 'the execute callback of an action server',
    EntityKind.DONE_CALLBACK: 'a done-callback',
    EntityKind.TASK: 'a task',
}


def find(context: Context) -> Iterator[Hit]:
    for race in races_of(context):
        if race.is_outside_groups and race.kind not in OF_OTHER_RULES:
            yield hit_of(race, _reminder(race))
    yield from map(_hit, late_claims(context))


def _hit(late: LateClaim) -> Hit:
    name, execute = late.asked.name, late.execute
    asks = late.server.function_name or late.server.display_name
    place = late.asked.source or late.server.defined or late.server.source
    assert place is not None, 'a read of a function that was followed'
    claimed = late.claim.source
    return Hit(
        place=place,
        message=f'{asks} accepts goals by {name}, which {execute.display_name} changes only '
        'when it '
        'runs: of two goals that arrive together, both may be accepted',
        help=f'change {name} in {asks}, under the lock under which it is asked for, and undo it '
        f'at the end of {execute.display_name}',
        subjects=(late.server.name, execute.name, name),
        chain=tuple(Remark(at, 'called from here') for at in late.asked.chain),
        related=(Remark(claimed, f'{execute.display_name} changes it here'),) if claimed else (),
    )


def _reminder(race: Race) -> str:
    outside = next(c for c in _callbacks(race) if c.groupless)
    what = _WHAT.get(outside.entity or EntityKind.TASK, 'a task')
    return f'; {shown([outside])} is {what} and runs outside every callback group'


def _callbacks(race: Race) -> tuple[Callback, ...]:
    doers = (use.doer for use in (race.first, *race.others))
    return tuple(doer for doer in doers if isinstance(doer, Callback))


RULE = Rule(
    code='CC303',
    slug='outside-groups',
    severity=Severity.WARNING,
    title='Race with work outside every callback group',
    what='An attribute is updated by a callback and by a done-callback, an executor task or the '
    'execute callback of an action server. These look as if a group protected them, but they run '
    'outside every group. The same holds for a state by which a goal callback accepts goals, if '
    'the execute callback claims it only later and then releases it: goals that arrive together '
    'all find it free.',
    why='`ActionServer.notify_execute`, `Executor.create_task` and done-callbacks of '
    '`call_async` futures become tasks without an entity and without a group, so they may '
    'overlap every callback and each other. Sources: rclpy 7.1.6 and 9.1.2, `action/server.py`, '
    '`executors.py` (`create_task`), `task.py`. Measured: a done-callback overlapped with the '
    'timers of the one exclusive group of its node.',
    bad="""\
class Arm(Node):
    def tick(self):
        self.load += self.cost()
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_done)

    def on_done(self, future):
        self.load -= self.cost()
""",
    good="""\
class Arm(Node):
    def tick(self):
        with self.lock:
            self.load += self.cost()
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_done)

    def on_done(self, future):
        with self.lock:
            self.load -= self.cost()
""",
    mend='Hold one `threading.Lock` around both. A callback group does not reach such work.',
    find=find,
)
