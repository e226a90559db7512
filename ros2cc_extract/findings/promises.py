"""
What a check says of a unit in five promises: kept, broken, or not decided and why.

A promise is kept only where the model of rclpy's executors proves it and nothing that it rests on
is open. It is broken only where a finding says so. Everything else is undecided.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from enum import Enum

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.answers_of_others import answers_assumed
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.base.rule import Context, Doer
from ros2cc_extract.findings.base.wording import called
from ros2cc_extract.findings.late_values import used_before_main_gives_it
from ros2cc_extract.findings.races.handed_functions import (
    races_with_others,
    races_with_threads_left,
)
from ros2cc_extract.findings.rules.deadlocks.never_ends import RULE as NEVER_ENDS
from ros2cc_extract.findings.rules.deadlocks.never_ends import open_facts
from ros2cc_extract.findings.rules.deadlocks.undecided_wait import OUTSIDE_WAIT, UNDECIDED
from ros2cc_extract.findings.rules.starvation import long_sleep
from ros2cc_extract.findings.waits.verdicts import NODE_KEPT, PROGRESS, SELF_OVERLAP
from ros2cc_extract.findings.waits.workers import Workers, is_one_thread, workers_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import OUTSIDE, PAUSES, TIME, WORKING_LOOP, Needs
from ros2cc_extract.spec.model import ActivityKind, GroupType, Spec
from ros2cc_extract.verify.results.load import LoadKind, Serving, demands_of, load_of
from ros2cc_extract.verify.results.results import QueryResult, Verdict, Verification


class Promise(Enum):
    """What a developer wants to rely on, in the words of the report."""

    DEADLOCK = 'no deadlock'
    WAITS = 'every wait ends'
    STARVATION = 'no starvation'
    RACES = 'no data race'
    SETTINGS = 'settings have an effect'


class Mark(Enum):
    """What is known of a promise."""

    KEPT = 'kept'
    OPEN = 'undecided'
    BROKEN = 'broken'


@dataclass(frozen=True)
class Judgement:
    """
    One promise of one unit.

    :param reason: why it is undecided, the codes of the findings that break it, or what it
        assumes of other programs where it is kept.
    """

    promise: Promise
    mark: Mark
    reason: str = ''


_MARKS = tuple(Mark)
"""What weighs more comes later."""
DEADLOCK, SERIAL = 'deadlock', 'serial'
RCLPY = 'rclpy'
"""The profile that models rclpy's own executors."""
_FOR_EVER = frozenset(f'CC{number}' for number in (*range(101, 120), 122, 127))
_CODES = {
    Promise.DEADLOCK: {'CC101', 'CC102', 'CC103', 'CC104', 'CC105', 'CC106', 'CC111', 'CC115'},
    Promise.WAITS: {*_FOR_EVER - {'CC107', 'CC117', 'CC119'}, 'CC204', 'CC205', 'CC206'},
    Promise.STARVATION: {
        *(f'CC20{number}' for number in range(1, 9)),
        *('CC103', 'CC113', 'CC116', 'CC118', 'CC127', 'CC405', 'CC406', 'CC407'),
    },
    Promise.RACES: {'CC107', 'CC117', 'CC119', *(f'CC30{number}' for number in range(1, 6))},
    Promise.SETTINGS: {f'CC40{number}' for number in range(1, 8)},
}
"""Rules whose findings break a promise."""
_FAMILIES: dict[Promise, set[str]] = {
    Promise.DEADLOCK: {DEADLOCK, 'pool_exhaustion'},
    Promise.WAITS: {PROGRESS, 'answered_spin'},
    Promise.STARVATION: {'starvation', NODE_KEPT},
    Promise.RACES: set(),
    Promise.SETTINGS: set(),
}
"""Claims of the model that have to hold for a promise."""
_ON_WAITS = (Promise.DEADLOCK, Promise.WAITS, Promise.STARVATION)
_ON_ENDS = (Promise.DEADLOCK, Promise.WAITS)
_OF_SERVING = {'CC107', 'CC406'}
"""Where the scan finds one of them, it is not known which spin serves a node from then on."""
_ASSUMED_ENDS = {OUTSIDE_WAIT.code: 'is assumed to end', UNDECIDED.code: 'is not decided'}


def judge(
    unit: Spec,
    verification: Verification,
    own: Sequence[Finding],
    near: Sequence[Finding] = (),
) -> tuple[Judgement, ...]:
    """
    Judge each promise of ``unit``.

    :param verification: by the model of rclpy's executors; by any other nothing is decided.
    :param own: findings about the unit, also accepted ones.
    :param near: findings in its files that may be about another unit.
    """
    judged = _Unit(unit, verification, own, near)
    return tuple(judged.judgement(promise) for promise in Promise)


def weakest(judgements: Iterable[tuple[Judgement, ...]]) -> tuple[Judgement, ...]:
    """Of what was judged under several releases, promise by promise what weighs most."""
    of_each = zip(*judgements, strict=True)
    return tuple(max(of_one, key=lambda each: _MARKS.index(each.mark)) for of_one in of_each)


@dataclass(frozen=True)
class _Unit:
    unit: Spec
    verification: Verification
    own: Sequence[Finding]
    near: Sequence[Finding]

    def judgement(self, promise: Promise) -> Judgement:
        own = [f for f in self.own if not (promise in _ON_ENDS and self._is_timed(f))]
        broken = sorted({f.code for f in own if _breaks(f, promise)})
        if broken:
            return Judgement(promise, Mark.BROKEN, ', '.join(broken))
        stuck = sorted({f.code for f in self.own if _breaks(f, Promise.WAITS)})
        if promise in _ON_WAITS and stuck and any(self._refuted(promise)):
            return Judgement(promise, Mark.BROKEN, ', '.join(stuck))
        if promise is Promise.DEADLOCK and any(map(self._is_of_several, self.own)):
            return Judgement(promise, Mark.BROKEN, NEVER_ENDS.code)
        reason = next(self._doubts(promise, own), '')
        if reason:
            return Judgement(promise, Mark.OPEN, reason)
        assumed = self._assumed() if promise is Promise.WAITS else ''
        return Judgement(promise, Mark.KEPT, assumed)

    def _is_timed(self, finding: Finding) -> bool:
        """Whether it is about a wait that comes to an end in any case, by its time-out."""
        doers = Context(self.unit).doers
        here = [b for doer in doers for b in doer.blocking if b.source == finding.place]
        return bool(here) and all(isinstance(block.seconds, float) for block in here)

    def _assumed(self) -> str:
        """By what waits end that the unit itself does not end."""
        timed = [f for f in self.own if _breaks(f, Promise.WAITS) and self._is_timed(f)]
        alone = [f'one by its time-out alone ({f.code} at {_at(f)})' for f in timed]
        last = [
            f'as long as the program gets to {_in_file(place)}, which ends that of {called(doer)}'
            for doer in self._ended_last()
            for block in doer.blocking
            if (place := block.at_end) is not None and place != block.source
        ]
        return '; '.join(filter(None, [answers_assumed(self.unit), *alone, *dict.fromkeys(last)]))

    def _ended_last(self) -> list[Doer]:
        """The threads that stand still in the model until the program ends their waits."""
        refuted = Verdict.NOT_SATISFIED
        claims = (r for r in self.verification.results if r.family == PROGRESS)
        stuck = {name for claim in claims if claim.verdict is refuted for name in claim.callbacks}
        doers = Context(self.unit).doers
        return [doer for doer in doers if doer.name in stuck and _is_ended_last(doer)]

    def _is_of_several(self, finding: Finding) -> bool:
        """Whether several units together stand still, as only their common model shows."""
        is_together = finding.unit is not None and finding.unit != self.unit.name
        return is_together and finding.code == NEVER_ENDS.code

    def _doubts(self, promise: Promise, own: Sequence[Finding]) -> Iterator[str]:
        """Give what keeps a promise from being proven, what concerns all promises first."""
        yield from self._gaps()
        for finding in self.near:
            is_noted = promise is Promise.RACES and finding.code in _CODES[promise]
            if is_noted or _breaks(finding, promise):
                yield f'{finding.code} at {_at(finding)}, which may concern it'
        for finding in own:
            if finding.code in _CODES[promise]:
                yield f'{finding.code} at {_at(finding)}'
        if promise in _ON_WAITS:
            yield from self._lost_service()
        yield from self._verdicts(promise)
        if promise in _ON_WAITS:
            yield from self._open_waits(promise)
        if promise is Promise.STARVATION:
            yield from _open_rounds(self.unit)
            yield from _overload(self.unit)
            yield from _open_pauses(self.unit)
        if promise is Promise.RACES:
            yield from _copies(self.unit)
            yield from races_with_others(self.unit)
            yield from races_with_threads_left(self.unit)
            yield from used_before_main_gives_it(self.unit)
        if promise is Promise.SETTINGS:
            yield from self._without_effect()

    def _gaps(self) -> Iterator[str]:
        if self.verification.defect:
            yield 'an internal error'
        elif self.verification.profile != RCLPY:
            yield "only the embedded checker and the model of rclpy's executors decide it"
        elif not any(r.family == DEADLOCK for r in self.verification.results):
            yield 'it was not asked'
        fact = open_facts(Context(self.unit))
        if fact:
            yield fact
        for each in Context(self.unit).doers:
            if each.unresolved is not None:
                yield f'{each.display_name} is not followed ({each.unresolved.reason})'
        for finding in (*self.own, *self.near):
            if finding.code == 'CC500':
                yield f'{finding.message} ({_at(finding)})'

    def _lost_service(self) -> Iterator[str]:
        """What lets a spin go on without its nodes, or end, as no model of a unit has it."""
        for finding in (*self.own, *self.near):
            is_told = finding.unit is None and finding.severity is not Severity.NOTE
            if is_told and finding.code in _OF_SERVING:
                yield f'after {finding.code} at {_at(finding)} a spin may serve the node no more'

    def _verdicts(self, promise: Promise) -> Iterator[str]:
        for result in self._results(promise):
            if result.verdict is Verdict.UNDECIDED:
                yield result.reason or 'a limit was hit'
        for result in self._refuted(promise):
            yield f'the model refutes "{result.words}", and no rule explains it: see --verdicts'

    def _refuted(self, promise: Promise) -> Iterator[QueryResult]:
        """What has no good reason: a thread may wait until the program ends that, as others do."""
        last = {doer.name for doer in self._ended_last()}
        refuted = [r for r in self._results(promise) if r.verdict is Verdict.NOT_SATISFIED]
        if promise is Promise.DEADLOCK and last and not any(self._refuted(Promise.WAITS)):
            return
        for result in refuted:
            if result.family != PROGRESS or not last.issuperset(result.callbacks):
                yield result

    def _results(self, promise: Promise) -> Iterator[QueryResult]:
        families = _FAMILIES[promise]
        return (result for result in self.verification.results if result.family in families)

    def _open_waits(self, promise: Promise) -> Iterator[str]:
        for finding in self.own:
            words = _ASSUMED_ENDS.get(finding.code)
            if words and (promise is not Promise.DEADLOCK or finding.code == UNDECIDED.code):
                yield f'the wait at {_at(finding)} {words}'

    def _without_effect(self) -> Iterator[str]:
        workers = workers_of(self.unit.executor)
        is_pool = isinstance(workers, Workers) and workers.count > 1
        if self.unit.unresolved:
            fact = self.unit.unresolved[0]
            yield f'{fact.fact} of {fact.subject} is not known ({fact.reason})'
        overlapping = [
            each
            for each in self.verification.results
            if each.family == SELF_OVERLAP and each.verdict is Verdict.NOT_SATISFIED
        ]
        for result in self.verification.results:
            if result.family == SERIAL and is_pool and not overlapping:
                if result.verdict is Verdict.UNDECIDED:
                    yield result.reason or 'a limit was hit'
                elif result.verdict is Verdict.SATISFIED:
                    yield 'no two callbacks ever run at the same time'


def _is_ended_last(doer: Doer) -> bool:
    """Whether the program ends each wait of it that may last, when its own spin is over."""
    ended_by_others = {TIME, OUTSIDE}
    lasting = [
        block
        for block in doer.blocking
        if block.seconds is None
        and block.call != WORKING_LOOP
        and ended_by_others.isdisjoint(waker.by for waker in block.wakers)
    ]
    return bool(lasting) and all(
        block.at_end is not None and block.needs is not Needs.ALL for block in lasting
    )


def _breaks(finding: Finding, promise: Promise) -> bool:
    """A note on settings is as certain as a warning; any other says that it may be no harm."""
    is_sure = finding.severity is not Severity.NOTE or promise is Promise.SETTINGS
    return is_sure and finding.code in _CODES[promise]


def _copies(unit: Spec) -> Iterator[str]:
    """
    Which callbacks stand for several, and are kept apart by what each of these may have.

    A lock or a group that is made with each of them keeps none of the others out.
    """
    if is_one_thread(unit.executor):
        return
    groups = {group.name: group for group in unit.groups}
    for callback in unit.callbacks:
        group = groups.get(callback.group)
        is_one = group is not None and group.count == 1
        if callback.count == 1 or (is_one and group and group.type is GroupType.EXCLUSIVE):
            continue
        changes = [write for write in callback.writes if write.rests or write.update]
        if any(not is_one or write.locks for write in changes):
            name = callback.display_name
            yield f'{name} stands for several, each of which may have a group or lock of its own'


def _overload(unit: Spec) -> Iterator[str]:
    """The callbacks that may wait if more arrives than one run of each callback."""
    demands = demands_of(unit)
    for callback in unit.callbacks:
        if callback.builtin:
            continue
        load = load_of(unit, callback, demands)
        is_delay = load.kind is LoadKind.UNKNOWN and load.serving is not Serving.LEFTOVER
        if load.kind is not LoadKind.FINE and not is_delay:
            yield f'{callback.display_name}: {load.words}'


def _open_rounds(unit: Spec) -> Iterator[str]:
    """The sleeps of which it is not known how often they come while others wait."""
    for wait in long_sleep.of_unknown_rounds(Context(unit)):
        yield (
            f'{wait.caller.display_name} sleeps {wait.block.seconds:g} s in each round of a loop '
            f'({_in_file(wait.place)}), how often is not known'
        )


def _open_pauses(unit: Spec) -> Iterator[str]:
    """The sleeps of which it is not known how long they hold up others."""
    for callback in unit.callbacks:
        for block in callback.blocking:
            if block.call in PAUSES and isinstance(block.seconds, Unknown):
                at = f' at {block.source}' if block.source is not None else ''
                why = block.seconds.reason
                yield f'how long {callback.display_name} sleeps{at} is not known ({why})'


def about(
    findings: Iterable[Finding], unit: Spec, units: Sequence[Spec]
) -> tuple[list[Finding], list[Finding]]:
    """
    Give the findings that are surely about ``unit``, and those that may be.

    What the scan alone finds names a file and no unit; so does what several units find together.
    """
    own: list[Finding] = []
    near: list[Finding] = []
    by_name = {each.name: each for each in units}
    for finding in findings:
        named = by_name.get(finding.unit or '')
        if named is None:
            sharing = [each for each in units if finding.place.file in each.sources]
            if any(each is unit for each in sharing):
                (own if len(sharing) == 1 else near).append(finding)
            elif finding.unit is not None and _leads_to(finding, unit):
                near.append(finding)
        elif finding.unit == unit.name:
            # Many programs name their node alike: the file tells them apart.
            alike = [each for each in units if each.name == unit.name]
            holding = [each for each in alike if finding.place.file in each.sources]
            if not holding or any(each is unit for each in holding):
                own.append(finding)
        elif unit.entry is not None and named.entry == unit.entry and _names(finding, unit, named):
            near.append(finding)
    return own, near


def _leads_to(finding: Finding, unit: Spec) -> bool:
    """Whether what several units do together involves code of this one."""
    return any(remark.place.file in unit.sources for remark in finding.related)


def _names(finding: Finding, unit: Spec, named: Spec) -> bool:
    """Whether it is about what ``unit`` runs; a note, of nothing that the other has as well."""
    names = {each.name for each in unit.callbacks}
    names |= {each.name for each in unit.activities if each.kind is not ActivityKind.MAIN}
    if finding.severity is Severity.NOTE:
        names -= {each.name for each in named.callbacks}
        names -= {each.name for each in named.activities}
    return not names.isdisjoint(finding.subjects)


def _at(finding: Finding) -> str:
    return _in_file(finding.place)


def _in_file(place: Place) -> str:
    name = place.file.rpartition('/')[2]
    return f'{name}:{place.line}' if place.line else name
