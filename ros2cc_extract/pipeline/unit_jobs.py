"""
Verdicts and findings of many units: from the cache, or by a pool of workers.

What travels between processes is plain data, and what the cache keeps is JSON. A run that was
not asked for stays behind; asking for it later verifies the unit once more.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from functools import cached_property, partial
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from ros2cc_extract.cache_file import load_value, store_value, tidy, tool_version
from ros2cc_extract.deadline import Deadline
from ros2cc_extract.errors import InputError
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.jobs.pools import Pool, Processes
from ros2cc_extract.jobs.process_pool import usable_cores
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.pipeline.progress import Meter
from ros2cc_extract.pipeline.unit_task import Examined, Task
from ros2cc_extract.plain_data import Packer
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.results.evidence import LOST, Evidence
from ros2cc_extract.verify.results.results import NotKept, Verification
from ros2cc_extract.verify.search.options import Checker, Options

if TYPE_CHECKING:
    from ros2cc_extract.verify.search.known_answers import Shelf

FEWEST_TO_SHARE = 4
"""With fewer units to verify, children cost more than they save."""
INTERRUPTED = 'interrupted'


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

    :param found: what is known of them as plain data; ``None`` if it was not reached.
    :param interrupted: it was ended: what was not reached by then is undecided.
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
    Verify every unit: those that wait for each other first, then small ones; find what is there.

    :param folder: cache of earlier answers.
    :param meter: shows how many units are done; the states too where they are verified here.
    :param deadline: for all of them; what is not decided by then is undecided.
    :param pool: what runs the searches, by default the cores of this machine.
    :param known: answers of others by ``Task.key``; where they are given, nothing is verified.
    :param interrupted: it was ended before: only what the cache has is reported.
    """
    engines = {task.options.engine.value for task in tasks}
    version = '\0'.join((tool_version(), *sorted(engines)))
    shelf = _Later(folder, version)
    if known is not None:
        found = dict(enumerate(_all_known(tasks, known)))
    else:
        found = {n: each for n, task in enumerate(tasks) if (each := _load(task, folder))}
    left = sorted(set(range(len(tasks))) - set(found), key=lambda n: (tasks[n].turn, n))
    left = [] if interrupted else left
    pool = pool or Processes(usable_cores() if len(left) >= FEWEST_TO_SHARE else 1)
    # Others keep nothing for us, and a meter is here or nowhere.
    kept = _Later(None, version) if pool.is_remote else shelf
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
        _with_runs(found[number], task, shelf) if number in found else _interrupted(task)
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


def _answer(shelf: _Later, deadline: Deadline | None, meter: Meter | None, task: Task) -> Examined:
    """One job of ``examine_all``, wherever it is done."""
    # Imported here: what the cache has is reported without a checker, which loads slowly.
    from ros2cc_extract.pipeline.unit_examination import examine, unasked

    if deadline is not None and deadline.is_over:
        return unasked(task, deadline.reason)
    watch = meter.search(task.closed.spec.name) if meter is not None else None
    examined = examine(task, watch, deadline, shelf.shelf)
    _store(task, examined, shelf.folder)
    return examined


def _interrupted(task: Task) -> Examined:
    from ros2cc_extract.pipeline.unit_examination import unasked

    return unasked(task, INTERRUPTED)


@dataclass(frozen=True)
class _Later:
    """The answers that hold for parts of other units too, on demand."""

    folder: Path | None
    version: str

    @cached_property
    def shelf(self) -> Shelf:
        """One for all units of a check."""
        from ros2cc_extract.verify.search.known_answers import Shelf

        return Shelf(self.folder, self.version)


def _with_runs(examined: Examined, task: Task, shelf: _Later) -> Examined:
    """Runs that were left behind can be asked for again."""
    shown = _Again(task.closed, task.options, shelf).renew(examined.shown)
    if task.judging is None:
        return replace(examined, shown=shown, judged=shown)
    judged = _Again(task.closed, task.judging, shelf).renew(examined.judged)
    return replace(examined, shown=shown, judged=judged)


class _Again:
    """Verifies a unit once more, when one of its runs is asked for."""

    def __init__(self, closed: ClosedSpec, options: Options, shelf: _Later) -> None:
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
        from ros2cc_extract.verify.unit import verify_unit

        return verify_unit(self._closed, self._options, None, self._shelf.shelf)

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
