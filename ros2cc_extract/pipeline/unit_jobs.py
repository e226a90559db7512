"""
Verdicts and findings of many units: from the cache, or by a pool of workers.

What travels between processes is plain data, and what the cache keeps is JSON. A run that nobody
has asked for stays behind; whoever asks for it later has the unit verified once more.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import count
from pathlib import Path

from ros2cc_extract.cache_file import load_value, store_value, tidy, tool_version
from ros2cc_extract.deadline import Deadline, TimeOverError, ended_by
from ros2cc_extract.errors import InputError
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.by_release import of_all_releases
from ros2cc_extract.findings.collect import findings_of_unit
from ros2cc_extract.findings.waits_across_executors import findings_of_joined
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.generator.releases import felt
from ros2cc_extract.jobs.pools import Pool, Processes
from ros2cc_extract.jobs.process_pool import usable_cores
from ros2cc_extract.pipeline.progress import Meter
from ros2cc_extract.plain_data import Packer
from ros2cc_extract.spec.close import ClosedSpec, Policy, close
from ros2cc_extract.spec.joined_executors import Joined
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.settings import settings
from ros2cc_extract.verify.results.evidence import LOST, Evidence
from ros2cc_extract.verify.results.results import NotKept, QueryResult, Verification
from ros2cc_extract.verify.search.known_answers import Shelf
from ros2cc_extract.verify.search.options import Checker, OnProgress, Options
from ros2cc_extract.verify.undecided import failed_unit, is_defect, undecided_unit
from ros2cc_extract.verify.unit import verify_unit

LONGEST_JUDGEMENT_S = 10.0
FEWEST_TO_SHARE = 4
"""With fewer units to verify, children cost more than they save."""
INTERRUPTED = 'interrupted'


@dataclass(frozen=True)
class Task:
    """
    A unit to verify.

    :param unit: as it was extracted; ``closed`` is what the model shows of it.
    :param keeps_runs: every run is wanted, not only those that findings show.
    :param joined: of what units ``unit`` is made, where it is made of several.
    """

    unit: Spec
    closed: ClosedSpec
    options: Options
    keeps_runs: bool
    joined: Joined | None = None

    @property
    def judging(self) -> Options | None:
        """How findings are judged where that needs a model of its own: rclpy's executors."""
        options = self.options
        if options.profile is Profile.RCLPY or options.checker is not Checker.EMBEDDED:
            return None
        seconds = min(options.limits.seconds or LONGEST_JUDGEMENT_S, LONGEST_JUDGEMENT_S)
        limits = replace(options.limits, seconds=seconds)
        return replace(options, profile=Profile.RCLPY, limits=limits, structural=False)

    @property
    def rows(self) -> tuple[Behaviour, ...]:
        """What differs between the releases it is judged for; nothing where one is named."""
        options = self.judging or self.options
        is_for_one = self.closed.spec.rclpy is not None or options.profile is not Profile.RCLPY
        return () if is_for_one else felt(self.closed.spec)

    def under(self, release: str) -> Task:
        """The same unit under one release."""
        closed = replace(self.closed, spec=replace(self.closed.spec, rclpy=release))
        return replace(self, unit=replace(self.unit, rclpy=release), closed=closed)

    @property
    def size(self) -> int:
        """How much there is to verify, roughly."""
        return len(self.closed.spec.callbacks)

    @property
    def key(self) -> str:
        """Equal where nothing differs on which the answer depends."""
        text = f'{tool_version()}\0{self!r}'
        return hashlib.sha256(text.encode('utf-8', 'surrogatepass')).hexdigest()


@dataclass(frozen=True)
class Examined:
    """
    What is known of a unit.

    :param shown: the verdicts for the reader; ``judged`` are those that findings rest on.
    :param elsewhere: the like of ``judged`` under releases where the unit behaves otherwise.
    """

    shown: Verification
    judged: Verification
    findings: tuple[Finding, ...]
    elsewhere: tuple[Verification, ...] = ()

    @property
    def is_final(self) -> bool:
        """Whether no limit of this machine has cut it short."""
        return all(each.complete for each in (self.shown, self.judged, *self.elsewhere))


@dataclass(frozen=True)
class Kept:
    """
    What the cache keeps of a unit.

    :param judged: ``None`` where it is what is shown.
    """

    shown: Verification
    judged: Verification | None
    findings: tuple[Finding, ...]
    elsewhere: tuple[Verification, ...]

    @staticmethod
    def of(examined: Examined) -> Kept:
        """Write the same verdicts once."""
        shown, judged = examined.shown, examined.judged
        own = None if judged is shown else judged
        return Kept(shown, own, examined.findings, examined.elsewhere)

    @property
    def examined(self) -> Examined:
        """The unit as it was kept."""
        judged = self.judged or self.shown
        return Examined(self.shown, judged, self.findings, self.elsewhere)


KEPT: Packer[Kept] = Packer(Kept)


@dataclass(frozen=True)
class Examination:
    """
    All units.

    :param found: what is known of them as plain data; ``None`` where nobody has come to it.
    :param interrupted: somebody has ended it: what was not reached by then is undecided.
    """

    units: tuple[Examined, ...]
    found: tuple[Examined | None, ...]
    interrupted: bool


def examine_all(
    tasks: Sequence[Task],
    folder: Path | None,
    meter: Meter,
    deadline: Deadline | None = None,
    *,
    pool: Pool | None = None,
    known: Mapping[str, Examined] | None = None,
    interrupted: bool = False,
) -> Examination:
    """
    Verify every unit and find what there is to find, small units first.

    :param folder: cache of earlier answers.
    :param meter: shows how many units are done; the states too where they are verified here.
    :param deadline: for all of them; what is not decided by then is undecided.
    :param pool: who verifies, by default the cores of this machine.
    :param known: answers of others by ``Task.key``; where they are given, nothing is verified.
    :param interrupted: somebody has ended it before: only what the cache knows is told.
    """
    engines = {task.options.engine.value for task in tasks}
    shelf = Shelf(folder, '\0'.join((tool_version(), *sorted(engines))))
    if known is not None:
        found = dict(enumerate(_all_known(tasks, known)))
    else:
        found = {n: each for n, task in enumerate(tasks) if (each := _load(task, folder))}
    left = sorted(set(range(len(tasks))) - set(found), key=lambda n: (tasks[n].size, n))
    left = [] if interrupted else left
    pool = pool or Processes(usable_cores() if len(left) >= FEWEST_TO_SHARE else 1)
    # Others keep nothing for us, and a meter is here or nowhere.
    kept = (None, Shelf()) if pool.is_remote else (folder, shelf)
    work = partial(_answer, kept, deadline, meter if pool.size == 1 else None)
    finished = count(len(found))
    meter.step(next(finished), len(tasks))
    try:
        with closing(pool.each(work, [tasks[number] for number in left], deadline)) as answers:
            for place, examined in answers:
                found[left[place]] = examined
                if pool.is_remote:
                    _store(tasks[left[place]], examined, folder)
                meter.step(next(finished), len(tasks))
    except KeyboardInterrupt:
        interrupted = True
    if folder is not None and left:
        tidy(folder)
    units = (
        _with_runs(found[number], task, shelf) if number in found else _unasked(task, INTERRUPTED)
        for number, task in enumerate(tasks)
    )
    return Examination(tuple(units), tuple(map(found.get, range(len(tasks)))), interrupted)


def _all_known(tasks: Sequence[Task], known: Mapping[str, Examined]) -> Iterator[Examined]:
    for task in tasks:
        examined = known.get(task.key)
        if examined is None:
            what = f'unit {task.unit.name} is in none of the results as it is asked for now'
            raise InputError(what, None, 'give the same sources and options to all shards')
        yield examined


def _answer(
    kept: tuple[Path | None, Shelf], deadline: Deadline | None, meter: Meter | None, task: Task
) -> Examined:
    """One job of ``examine_all``, wherever it is done."""
    folder, shelf = kept
    if deadline is not None and deadline.is_over:
        return _unasked(task, deadline.reason)
    watch = meter.search(task.closed.spec.name) if meter is not None else None
    examined = examine(task, watch, deadline, shelf)
    _store(task, examined, folder)
    return examined


def _findings(task: Task, judged: Verification | None) -> tuple[Finding, ...]:
    if task.joined is not None:
        return findings_of_joined(task.joined, judged)
    return findings_of_unit(task.unit, judged)


def joined_task(joined: Joined, policy: Policy, options: Options) -> Task:
    """What several units are asked together: only findings are told of it."""
    task = Task(joined.spec, close(joined.spec, policy), options, False, joined)
    return replace(task, options=task.judging or options)


def _unasked(task: Task, reason: str) -> Examined:
    """A unit that nobody has come to."""
    shown = undecided_unit(task.closed, task.options, reason)
    judged = undecided_unit(task.closed, task.judging, reason) if task.judging else shown
    return Examined(shown, judged, _findings(task, judged))


def examine(
    task: Task,
    watch: OnProgress | None = None,
    deadline: Deadline | None = None,
    shelf: Shelf | None = None,
) -> Examined:
    """
    Verify one unit; runs that are not kept are told by nobody but ``_with_runs``.

    What is wrong with our own model of it is told, and the other units go on.
    """
    try:
        return _examine(task, watch, deadline, shelf or Shelf())
    except Exception as error:
        if not is_defect(error):
            raise  # such as a program that was asked for and is not there
        shown = failed_unit(task.closed, task.options, error)
        judged = failed_unit(task.closed, task.judging, error) if task.judging else shown
        return Examined(shown, judged, _findings(task, None))


def _examine(
    task: Task, watch: OnProgress | None, deadline: Deadline | None, shelf: Shelf
) -> Examined:
    shown = _verify_in_time(task.closed, task.options, watch, deadline, shelf)
    judged = shown
    if task.judging:
        judged = _verify_in_time(task.closed, task.judging, watch, deadline, shelf)
    first, *others = settings(task.rows)
    tasks = [task.under(setting.release) for setting in others]
    options = task.judging or task.options
    elsewhere = [_verify_in_time(each.closed, options, watch, deadline, shelf) for each in tasks]
    found = [_findings(*each) for each in zip([task, *tasks], [judged, *elsewhere], strict=True)]
    findings = of_all_releases([*zip([first, *others], found, strict=True)], task.rows)
    kept = _kept(shown, task.keeps_runs)
    own = _kept(judged, False) if judged is not shown else kept
    return Examined(kept, own, findings, tuple(_kept(each, False) for each in elsewhere))


def _verify_in_time(
    closed: ClosedSpec,
    options: Options,
    watch: OnProgress | None,
    deadline: Deadline | None,
    shelf: Shelf,
) -> Verification:
    """Searches look at the clock, and tell what they know; what else takes long is ended."""
    options = replace(options, limits=replace(options.limits, deadline=deadline))
    try:
        with ended_by(deadline):
            return verify_unit(closed, options, watch, shelf)
    except TimeOverError:
        return undecided_unit(closed, options, deadline.reason if deadline else '')


def _kept(verification: Verification, with_runs: bool) -> Verification:
    """The verification as plain data, without what differs from run to run."""
    results = tuple(_kept_result(result, with_runs) for result in verification.results)
    return replace(verification, seconds=0.0, peak_mb=0.0, results=results)


def _kept_result(result: QueryResult, with_runs: bool) -> QueryResult:
    if not result.run and not result.seconds:
        return result  # as most of a hundred thousand may be, and to copy them takes its time
    if with_runs:
        return replace(result, seconds=0.0, run=result.evidence)
    return replace(result, seconds=0.0, run=NotKept.RUN if result.run else None)


def _with_runs(examined: Examined, task: Task, shelf: Shelf) -> Examined:
    """Runs that were left behind can be asked for again."""
    shown = _Again(task.closed, task.options, shelf).renew(examined.shown)
    if task.judging is None:
        return replace(examined, shown=shown, judged=shown)
    judged = _Again(task.closed, task.judging, shelf).renew(examined.judged)
    return replace(examined, shown=shown, judged=judged)


class _Again:
    """Verifies a unit once more, when one of its runs is asked for."""

    def __init__(self, closed: ClosedSpec, options: Options, shelf: Shelf) -> None:
        self._closed = closed
        self._shelf = shelf
        self._options = options

    def renew(self, verification: Verification) -> Verification:
        """The same verdicts, with runs to ask for."""
        results = tuple(
            replace(result, run=partial(self._run, number))
            if result.run is NotKept.RUN
            else result
            for number, result in enumerate(verification.results)
        )
        return replace(verification, results=results)

    @cached_property
    def _verification(self) -> Verification:
        return verify_unit(self._closed, self._options, None, self._shelf)

    def _run(self, number: int) -> Evidence:
        evidence = self._verification.results[number].evidence
        return evidence or LOST


def _load(task: Task, folder: Path | None) -> Examined | None:
    if folder is None or task.options.checker is not Checker.EMBEDDED:
        return None
    kept = load_value(folder / f'{task.key}.verdicts', KEPT)
    return kept.examined if kept is not None else None


def _store(task: Task, examined: Examined, folder: Path | None) -> None:
    if folder is None or task.options.checker is not Checker.EMBEDDED:
        return
    if examined.is_final:
        store_value(folder / f'{task.key}.verdicts', Kept.of(examined), KEPT)
