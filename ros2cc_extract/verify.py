"""
Asks a checker for the verdicts of a unit or of a model file, and ties the answers to words.

Knows neither syntax trees nor output formats; every run it hands on was replayed by the checker.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property, partial
from pathlib import Path

from ros2cc_extract.checker.api import (
    Answer,
    CheckResult,
    EngineKind,
    Fairness,
    Limits,
    Model,
    Progress,
    Query,
    check,
    load_model,
    read_model,
    read_queries,
)
from ros2cc_extract.checker.api import Verdict as Verdict
from ros2cc_extract.errors import InputError
from ros2cc_extract.evidence import Evidence, Names, tell
from ros2cc_extract.generator import build
from ros2cc_extract.places import Place
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verifyta import LicenceError, find_verifyta, run_verifyta
from ros2cc_extract.verifyta import Runs as Runs

OnProgress = Callable[[Progress], None]


class Checker(Enum):
    """Who answers."""

    EMBEDDED = 'embedded'
    VERIFYTA = 'verifyta'


@dataclass(frozen=True, kw_only=True)
class Options:
    """
    How to verify; the defaults are those of the command line.

    :param verifyta: the program, where it is not to be looked for.
    """

    checker: Checker = Checker.EMBEDDED
    verifyta: Path | None = None
    runs: Runs = Runs.TOGETHER
    profile: build.Profile = build.Profile.PAPER
    text: build.Text = build.Text.COMPACT
    max_cycle: int | None = 1
    engine: EngineKind = EngineKind.AUTO
    fairness: Fairness = Fairness.NONE
    reduction: bool = True
    limits: Limits = field(default_factory=Limits)


@dataclass(frozen=True, kw_only=True)
class QueryResult:
    """
    One verdict with its evidence.

    :param family: value of ``generator.build.Family``; ``None`` for a query we did not write.
    :param callbacks: names of the callbacks the query is about.
    :param seconds: when it was decided, counted from the start of the exploration.
    :param run: the run behind the verdict, or what gives it; use ``evidence``.
    """

    family: str | None
    formula: str
    words: str
    callbacks: tuple[str, ...]
    verdict: Verdict
    reason: str | None
    seconds: float
    run: Evidence | Callable[[], Evidence] | None

    @cached_property
    def evidence(self) -> Evidence | None:
        """The run behind the verdict, replayed and told when it is first asked for."""
        return self.run() if callable(self.run) else self.run


@dataclass(frozen=True, kw_only=True)
class Verification:
    """
    All verdicts of one model.

    :param peak_mb: largest resident memory of the process, in MB.
    :param complete: false when a limit ended the exploration.
    :param assumptions: what was decided about open facts of the unit, in words.
    :param notes: what else the reader should know, such as a checker that could not be used.
    """

    model: str
    profile: str | None
    text: str | None
    engine: str
    states: int
    transitions: int
    seconds: float
    peak_mb: float
    complete: bool
    results: tuple[QueryResult, ...]
    assumptions: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def is_undecided(self) -> bool:
        """True when a limit left at least one query open."""
        return any(result.verdict is Verdict.UNDECIDED for result in self.results)


def verify_unit(
    closed: ClosedSpec, options: Options = Options(), progress: OnProgress | None = None
) -> Verification:
    """Render, check and tell one unit."""
    rendered = build.render(
        closed, profile=options.profile, text=options.text, max_cycle=options.max_cycle
    )
    if options.checker is Checker.VERIFYTA:
        try:
            return _ask_verifyta(rendered, closed, options)
        except LicenceError as error:
            embedded = replace(options, checker=Checker.EMBEDDED)
            note = f'{error}; the embedded checker was used'
            found = verify_unit(closed, embedded, progress)
            return replace(found, notes=(note, *found.notes))
    if options.text is build.Text.COMPACT:
        # It resets its variables itself: looking for dead ones costs time and finds no state less.
        options = replace(options, reduction=False)
    model = read_model(rendered.xml, f'{rendered.name}.xml')
    queries = [Query(q.formula, q.words, None) for q in rendered.queries]
    result = _check(model, queries, options, progress)
    names = Names.of(closed.spec)
    results = tuple(
        _result(answer, names, query.family.value, query.words, query.callbacks)
        for answer, query in zip(result.answers, rendered.queries, strict=True)
    )
    return _verification(
        rendered.name,
        result,
        results,
        profile=options.profile.value,
        text=options.text.value,
        assumptions=closed.assumptions,
        notes=_caveats(closed, options),
    )


def _caveats(closed: ClosedSpec, options: Options) -> tuple[str, ...]:
    notes = []
    if options.max_cycle is None:
        notes.append(f'arrivals without bound; fairness of a run: {options.fairness.value}')
    blocking = any(callback.blocking for callback in closed.spec.callbacks)
    if options.profile is build.Profile.PAPER and blocking:
        notes.append('the published model knows no blocking calls; the findings tell of them')
    return tuple(notes)


def _ask_verifyta(
    rendered: build.RenderedModel, closed: ClosedSpec, options: Options
) -> Verification:
    answers = run_verifyta(
        find_verifyta(options.verifyta),
        rendered.xml,
        [query.formula for query in rendered.queries],
        runs=options.runs,
        seconds=options.limits.seconds,
    )
    results = tuple(
        QueryResult(
            family=query.family.value,
            formula=query.formula,
            words=query.words,
            callbacks=query.callbacks,
            verdict=answer.verdict,
            reason=answer.reason,
            seconds=answer.seconds,
            run=None,
        )
        for query, answer in zip(rendered.queries, answers, strict=True)
    )
    together = options.runs is Runs.TOGETHER
    return Verification(
        model=rendered.name,
        profile=options.profile.value,
        text=options.text.value,
        engine='verifyta',
        states=max(answer.states for answer in answers),
        transitions=0,
        seconds=max(a.seconds for a in answers) if together else sum(a.seconds for a in answers),
        peak_mb=max(answer.peak_mb for answer in answers),
        complete=all(answer.verdict is not Verdict.UNDECIDED for answer in answers),
        results=results,
        assumptions=closed.assumptions,
    )


def verify_model(
    path: Path,
    queries_path: Path | None,
    options: Options = Options(),
    progress: OnProgress | None = None,
) -> Verification:
    """
    Check a model file, by the queries of a ``.q`` file or by those in the model.

    :raises InputError: when there is no query, or a file cannot be read.
    """
    model = load_model(path)
    queries = model.queries if queries_path is None else _load_queries(queries_path)
    if not queries:
        place = Place(str(queries_path or path))
        raise InputError('no query found', place, 'name a .q file after the model')
    result = _check(model, queries, options, progress)
    names = Names()
    results = tuple(
        _result(answer, names, None, answer.query.comment or answer.query.formula, ())
        for answer in result.answers
    )
    return _verification(path.name, result, results)


def _check(
    model: Model, queries: Sequence[Query], options: Options, progress: OnProgress | None
) -> CheckResult:
    return check(
        model,
        queries,
        limits=options.limits,
        engine=options.engine,
        fairness=options.fairness,
        reduction=options.reduction,
        progress=progress,
    )


def _load_queries(path: Path) -> tuple[Query, ...]:
    try:
        text = path.read_text(encoding='utf-8')
    except UnicodeDecodeError:
        raise InputError('no UTF-8 text', Place(str(path)), 'is this a .q file?') from None
    except OSError as error:
        raise InputError(f'cannot be read: {error.strerror}', Place(str(path))) from None
    return read_queries(text, str(path))


def _result(
    answer: Answer, names: Names, family: str | None, words: str, callbacks: tuple[str, ...]
) -> QueryResult:
    return QueryResult(
        family=family,
        formula=answer.query.formula,
        words=words,
        callbacks=callbacks,
        verdict=answer.verdict,
        reason=answer.reason,
        seconds=answer.seconds,
        run=partial(_tell, answer, names) if answer.replay else None,
    )


def _tell(answer: Answer, names: Names) -> Evidence:
    run = answer.path
    assert run is not None, 'only asked of answers that have a run'
    return tell(run, names)


def _verification(
    model: str,
    result: CheckResult,
    results: tuple[QueryResult, ...],
    *,
    profile: str | None = None,
    text: str | None = None,
    assumptions: tuple[str, ...] = (),
    notes: tuple[str, ...] = (),
) -> Verification:
    return Verification(
        model=model,
        profile=profile,
        text=text,
        engine=result.engine,
        states=result.states,
        transitions=result.transitions,
        seconds=result.seconds,
        peak_mb=result.peak_mb,
        complete=result.complete,
        results=results,
        assumptions=assumptions,
        notes=(*([result.note] if result.note else []), *notes),
    )
