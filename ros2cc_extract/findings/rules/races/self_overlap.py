"""CC304: a callback that may overlap itself updates an attribute."""

from __future__ import annotations

from collections.abc import Container, Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at
from ros2cc_extract.findings.races.flag_locks import shared_by
from ros2cc_extract.findings.races.joined_self_races import JoinedRaces, joined, message_of
from ros2cc_extract.findings.races.races import LOSING, RaceKind, races_of
from ros2cc_extract.findings.races.self_races import (
    SelfRace,
    SelfRaceKind,
    self_races_of,
    self_races_over_awaits,
)
from ros2cc_extract.findings.waits.one_shot_timers import (
    cancel_of,
    cancels_too_late,
    may_cancel_too_late,
)
from ros2cc_extract.findings.waits.overlap import interleaves, is_quick, overlaps_itself
from ros2cc_extract.findings.waits.remedies import LOCK_OF_LOOP, is_on_loop
from ros2cc_extract.findings.waits.verdicts import SELF_OVERLAP, refuting_run
from ros2cc_extract.findings.waits.workers import runs_in_parallel
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Act
from ros2cc_extract.spec.model import Activity, Callback


def find(context: Context) -> Iterator[Hit]:
    """Only where no other callback loses the same update: one lock mends both."""
    late = [callback for callback in context.written if _runs_again(callback, context)]
    yield from (_late_hit(callback, cancel_of(callback), context) for callback in late)
    losing = list(_losing(context))
    worse = set(_reported_of_others(context, LOSING[:2])) if losing else set()
    any_reported = worse | set(_reported_of_others(context, LOSING)) if losing else set()
    left = (
        race
        for race in losing
        if race.callback not in late
        and not (any_reported if race.is_whole else worse)
        & {(race.use.access.name, race.use.place), (race.use.access.name, race.callback.name)}
    )
    for joint in joined(left, lambda race: _severity(race, context)):
        yield _hit(joint, context)


def _runs_again(callback: Callback, context: Context) -> bool:
    """Whether a timer that is to run once may run beside itself before it is cancelled."""
    if not runs_in_parallel(context.unit.executor):
        return False
    is_free = context.group_of(callback).unresolved is None
    is_free = is_free and context.exclusive_group(callback) is None
    return is_free and may_cancel_too_late(callback)


def _late_hit(callback: Callback, cancel: Act | None, context: Context) -> Hit:
    every = callback.period_s
    period = f'its period of {every:g} s' if isinstance(every, float) else 'its period'
    is_sure = cancels_too_late(callback)
    how = 'runs several times, beside itself' if is_sure else 'may run several times'
    waits = 'sleeps' if is_sure else 'waits'
    when = f'longer than {period}' if is_sure else f', perhaps longer than {period},'
    return Hit(
        place=(cancel and cancel.source) or callback.defined or Place(callback.name),
        message=f'{callback.display_name} {waits} {when} before it cancels its timer here: what '
        f'should run once {how}',
        help='cancel the timer first, or put it into a mutually exclusive group',
        severity=None if is_sure else Severity.NOTE,
        subjects=(callback.name,),
        related=tuple(made_at(callback, context.group_of(callback))),
    )


def _losing(context: Context) -> Iterator[SelfRace]:
    """The worst race of each attribute that two runs of one callback may have."""
    for callback in shared_by(context):
        if overlaps_itself(callback, context):
            yield from self_races_of(callback, _stored_by_others(callback, context))
        elif interleaves(callback, callback, context):
            yield from self_races_over_awaits(callback, _stored_by_others(callback, context))


def _stored_by_others(callback: Callback, context: Context) -> frozenset[str]:
    """Attributes in which other functions store values, and not only clear them."""
    everybody: tuple[Callback | Activity, ...] = (*context.written, *context.unit.activities)
    others = (one for one in everybody if _text_of(one) != _text_of(callback))
    return frozenset(
        write.name
        for other in others
        for write in other.writes
        if not write.in_place and not write.clears
    )


def _text_of(doer: Callback | Activity) -> str:
    return doer.function.rpartition('.')[2] if doer.function else doer.name


def _reported_of_others(
    context: Context, kinds: Container[RaceKind]
) -> Iterator[tuple[str, Place | str]]:
    """Attributes with the place of the reported update, and with what else is named there."""
    for race in races_of(context):
        if race.kind in kinds:
            for name in race.names:
                yield name, race.first.place
                yield name, race.first.doer.name
                yield from ((name, use.doer.name) for use in race.others)


def _severity(race: SelfRace, context: Context) -> Severity | None:
    is_at_once = not race.waits and not race.use.access.later
    is_less = race.is_whole or (race.kind is SelfRaceKind.STALE_READ and is_at_once)
    is_less = is_less or (race.kind is SelfRaceKind.OVERWRITTEN and race.use.access.asked)
    return Severity.NOTE if is_less or is_quick(race.callback, context) else None


def _hit(joint: JoinedRaces, context: Context) -> Hit:
    """One for the callbacks that come to one line, and for what they do at others."""
    callbacks, race = joint.callbacks, joint.first
    made = (each for one in callbacks for each in made_at(one, context.group_of(one)))
    return Hit(
        place=race.use.place,
        message=message_of(joint),
        help=LOCK_OF_LOOP if is_on_loop(context.unit.executor) else _help(race),
        severity=_severity(race, context),
        subjects=(*(callback.name for callback in callbacks), *joint.names),
        related=(*joint.related(), *dict.fromkeys(made)),
        run=refuting_run(SELF_OVERLAP, context, race.callback),
    )


def _help(race: SelfRace) -> str:
    """A lock kept over an await stops the threads of the other runs."""
    group = 'put the callback into a mutually exclusive group'
    if race.callback.groupless:
        return _HELP_OUTSIDE[race.kind]
    if race.callback.coroutine and race.waits:
        return f'{group}, with what it awaits in another one'
    return f'{_HELP_OUTSIDE[race.kind]}, or {group}'


_HELP_OUTSIDE = {
    SelfRaceKind.LOST_UPDATE: 'hold a lock around the update',
    SelfRaceKind.STALE_READ: 'hold one lock from the read to the write',
    SelfRaceKind.OVERWRITTEN: 'keep it in a local variable, or let only one run in at a time',
}


RULE = Rule(
    code='CC304',
    slug='self-overlap',
    severity=Severity.WARNING,
    title='Callback that may overlap itself updates an attribute',
    what='A callback of a reentrant group, or one outside every group, reads an attribute and '
    'writes it back without a lock: at once (`+=`), after a test, or from a copy; or it writes '
    'an attribute, waits, and reads it back; or it looks for an item in a collection, waits, and '
    'changes that item. Two runs of the same callback may overlap. So may those of a timer that '
    'should run once and cancels itself only after it has slept longer than its period (a note '
    'where it waits for an unknown time): everything in it is done several times. The finding is '
    'only a note for an update of a number with nothing but constants and names between its read '
    'and its write (`self.n += 1`, see CC301), for a timer whose runs are known to be shorter '
    'than its period, for a done-callback that one such timer alone requests, once in a run, and '
    'for a test, or a copy of the value, that is followed by the write without a wait in between, '
    'and for the copy without a call either. What lies behind a flag that one run alone gets past '
    '(`if self.busy: return`, and `self.busy = True` with nothing called in between) is not '
    'reported, unless others lower that flag. Where another callback '
    'may lose the same update, CC301 or CC303 is reported instead. There is one finding for all '
    'callbacks that come to one line, and for all attributes of one callback.',
    why='The executor may take an entity again as soon as its data was taken; a reentrant group '
    'refuses nothing, so one subscription runs on several threads at once. Source: rclpy 7.1.6 '
    'and 9.1.2, `executors.py` (`_make_handler`), `callback_groups.py` '
    '(`ReentrantCallbackGroup`). Measured: three overlapping runs of one timer.',
    bad="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_subscription(
            Image, 'image', self.on_image, 10, callback_group=ReentrantCallbackGroup())

    def on_image(self, msg):
        self.received += len(msg.data)
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
