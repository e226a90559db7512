"""CC304: a callback that may overlap itself updates an attribute."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.overlap import overlaps_itself
from ros2cc_extract.findings.races import RaceKind, Use, keep_apart, races_of
from ros2cc_extract.findings.rule import Context, Hit, Rule
from ros2cc_extract.findings.verdicts import SELF_OVERLAP, refuting_run
from ros2cc_extract.findings.words import made_at
from ros2cc_extract.places import Place
from ros2cc_extract.spec.deeds import Access
from ros2cc_extract.spec.model import Callback, EntityKind

_TWICE = {
    EntityKind.TIMER: 'when a run lasts longer than the period',
    EntityKind.ACTION_EXECUTE: 'when there are two goals',
    EntityKind.DONE_CALLBACK: 'when two answers come together',
}


def find(context: Context) -> Iterator[Hit]:
    """Only where no other callback loses the same update: one lock mends both."""
    losing = list(_losing(context))
    told = set(_told_of_others(context)) if losing else set()
    for use in losing:
        name = use.access.name
        if not told & {(name, use.place), (name, use.callback.name)}:
            yield _hit(use, context)


def _losing(context: Context) -> Iterator[Use]:
    """The first update of each attribute that two runs of one callback may lose."""
    for callback in context.written:
        if not overlaps_itself(callback, context):
            continue
        for name in dict.fromkeys(access.name for access in callback.writes):
            unlocked = [a for a in callback.writes if a.name == name and _can_lose(a)]
            if unlocked:
                yield Use(callback, unlocked[0])


def _told_of_others(context: Context) -> Iterator[tuple[str, Place | str]]:
    """Attributes with the place of the update that is told, and with who else is named there."""
    for race in races_of(context):
        if race.kind is RaceKind.LOST_UPDATE:
            for name in race.names:
                yield name, race.first.place
                yield from ((name, use.callback.name) for use in race.others)


def _hit(use: Use, context: Context) -> Hit:
    callback, name = use.callback, use.access.name
    default = 'when messages come together'
    when = _TWICE.get(callback.entity, default) if callback.entity else default
    return Hit(
        place=use.place,
        message=f'{callback.display_name} may overlap itself {when}, and updates {name} from its '
        'old value without a lock: one of the changes can get lost',
        help='hold a lock around the update, or put the callback into a mutually exclusive group'
        if not callback.groupless
        else 'hold a lock around the update',
        severity=Severity.NOTE if _is_quick_timer(callback) else None,
        subjects=(callback.name, name),
        related=tuple(made_at(callback, context.group_of(callback))),
        run=refuting_run(SELF_OVERLAP, context, callback),
    )


def _can_lose(access: Access) -> bool:
    is_alone = keep_apart(access.locks, access.locks)
    return access.update and not access.in_place and not is_alone


def _is_quick_timer(callback: Callback) -> bool:
    """Without any wait a run hardly outlasts the period."""
    return callback.entity is EntityKind.TIMER and not callback.blocking


RULE = Rule(
    code='CC304',
    slug='self-overlap',
    severity=Severity.WARNING,
    title='Callback that may overlap itself updates an attribute',
    what='A callback of a reentrant group, or one outside every group, reads an attribute and '
    'writes it back without a lock. Two runs of the same callback may coincide. For a timer '
    'that never waits it is only a note. Where another callback may lose the same update, CC301 '
    'or CC303 stands for both.',
    why='An entity may be collected again as soon as its data was taken; a reentrant group '
    'refuses nothing, so that one subscription runs on several threads at once. Source: rclpy '
    '7.1.6 and 9.1.2, `executors.py` (`_make_handler`), `callback_groups.py` '
    '(`ReentrantCallbackGroup`). Measured: three overlapping runs of one timer.',
    bad="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_subscription(
            Image, 'image', self.on_image, 10, callback_group=ReentrantCallbackGroup())

    def on_image(self, msg):
        self.frames += 1
""",
    good="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_subscription(
            Image, 'image', self.on_image, 10, callback_group=MutuallyExclusiveCallbackGroup())
""",
    mend='Give the callback a mutually exclusive group of its own, or hold a lock.',
    find=find,
)
