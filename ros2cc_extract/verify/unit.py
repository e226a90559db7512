"""
Asks a checker for the verdicts of a unit or of a model file, and ties the answers to words.

Knows neither syntax trees nor output formats; every run it hands on was replayed by the checker.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import partial
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
    model_text,
    read_model,
    read_queries,
)
from ros2cc_extract.checker.api import Verdict as Verdict
from ros2cc_extract.checker.refutation.random_runs import dive
from ros2cc_extract.checker.refutation.waypoints import refute
from ros2cc_extract.checker.uppaal.model import MOST_MODEL_BYTES
from ros2cc_extract.errors import InputError, ModelFormatError
from ros2cc_extract.files import read_named
from ros2cc_extract.generator import build
from ros2cc_extract.once import known_of
from ros2cc_extract.places import Place
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.again import ask_again
from ros2cc_extract.verify.arrivals import TWO_ARRIVALS, needs_two_arrivals
from ros2cc_extract.verify.asking import Found, Key, key_of, unasked
from ros2cc_extract.verify.caveats import caveats_of, left_out_of_deadlocks
from ros2cc_extract.verify.doubts import doubts_in
from ros2cc_extract.verify.evidence import Evidence, Names, tell
from ros2cc_extract.verify.known import Shelf
from ros2cc_extract.verify.load import demands_of, load_of
from ros2cc_extract.verify.narrowing import Refuters, joined, narrow
from ros2cc_extract.verify.reading import NotReadError, limited_reading, read_in_time
from ros2cc_extract.verify.results import QueryResult as QueryResult
from ros2cc_extract.verify.results import Verification as Verification
from ros2cc_extract.verify.structural import structural_verdicts
from ros2cc_extract.verify.uppaal.run import UppaalRun
from ros2cc_extract.verify.uppaal.verifyta import LicenceError, find_verifyta
from ros2cc_extract.verify.uppaal.verifyta import Runs as Runs
from ros2cc_extract.verify.uppaal.verifyta_check import check_by_verifyta
from ros2cc_extract.verify.used_up import refute_by_using_up

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
    :param jobs: threads that explore one model together; no answer depends on them.
    :param structural: profile rclpy also asks who starves under unlimited arrivals.
    :param families: what alone is asked; all that there is where it is left out.
    """

    checker: Checker = Checker.EMBEDDED
    verifyta: Path | None = None
    runs: Runs = Runs.TOGETHER
    profile: build.Profile = build.Profile.PAPER
    text: build.Text = build.Text.COMPACT
    max_cycle: int | None = 1
    structural: bool = True
    families: frozenset[build.Family] | None = None
    engine: EngineKind = EngineKind.AUTO
    fairness: Fairness = Fairness.NONE
    reduction: bool = True
    limits: Limits = field(default_factory=Limits)
    jobs: int = 1


def verify_unit(
    closed: ClosedSpec,
    options: Options = Options(),
    progress: OnProgress | None = None,
    shelf: Shelf | None = None,
) -> Verification:
    """
    Render, check and tell one unit.

    :param shelf: answers that hold for parts of other units too; used and added to.
    """
    options = replace(options, limits=options.limits.begun())
    shelf = Shelf() if shelf is None else shelf
    queries = build.queries_of(closed, profile=options.profile, max_cycle=options.max_cycle)
    if options.families is not None:
        queries = tuple(query for query in queries if query.family in options.families)
    if options.text is build.Text.COMPACT:
        # It resets its variables itself: looking for dead ones costs time and finds no state less.
        options = replace(options, reduction=False)
    of_two = [q for q in queries if needs_two_arrivals(q, closed.spec, options.profile)]
    if options.max_cycle != 1:
        of_two = []
    twice_asked = set(map(key_of, of_two))
    once_asked = [query for query in queries if key_of(query) not in twice_asked]
    found = _ask(once_asked, closed, options, progress, shelf)
    if of_two:
        twice = replace(options, max_cycle=TWO_ARRIVALS)
        found = joined(found, _ask(of_two, closed, twice, progress, shelf))
    if options.max_cycle == 1 and options.profile is build.Profile.RCLPY:
        found = ask_again(
            found,
            queries,
            closed,
            lambda left, more, limits: _ask(left, more, options, progress, shelf, limits),
            options.limits,
        )
        if _may_be_sliced(options):
            by_chance = partial(_dive, options=options)
            found = refute_by_using_up(found, queries, closed, by_chance, options.limits)
    left_out = left_out_of_deadlocks(closed.spec, options.profile)
    results = tuple(
        _as_far_as_modelled(_as_asked(found.results[key_of(query)], query, left_out), query)
        for query in queries
    )
    structural = tuple(_structural(closed, options, shelf))
    is_open = any(result.verdict is Verdict.UNDECIDED for result in structural)
    return _verification(
        closed.spec.name,
        replace(found.check, complete=found.check.complete and not is_open),
        _with_loads((*results, *structural), closed),
        profile=options.profile.value,
        text=options.text.value,
        assumptions=closed.assumptions,
        notes=_caveats(closed, options, found),
    )


def _ask(
    queries: Sequence[build.Query],
    closed: ClosedSpec,
    options: Options,
    progress: OnProgress | None,
    shelf: Shelf,
    limits: Limits | None = None,
) -> Found:
    """Ask slices where they may decide, else the whole unit."""
    limits = limits or options.limits
    search = partial(_search, options=options, progress=progress)
    if options.max_cycle is not None and _may_be_sliced(options):
        refuters = Refuters(partial(_refute, options=options), partial(_dive, options=options))
        return narrow(closed, queries, options.max_cycle, search, limits, shelf, refuters)
    return search(closed, [key_of(query) for query in queries], limits)


def _as_asked(result: QueryResult, query: build.Query, left_out: str) -> QueryResult:
    """A slice has numbers and names of its own; ``left_out`` is said of deadlocks."""
    words = f'{left_out}{query.words}' if query.family is build.Family.DEADLOCK else query.words
    if (result.formula, result.words, result.callbacks) == (query.formula, words, query.callbacks):
        return result
    return replace(result, formula=query.formula, words=words, callbacks=query.callbacks)


def _render(closed: ClosedSpec, options: Options) -> build.ModelAlone:
    return build.render_alone(
        closed, profile=options.profile, text=options.text, max_cycle=options.max_cycle
    )


def _read(closed: ClosedSpec, options: Options) -> tuple[build.ModelAlone, Model]:
    """Render and read; the last one is kept, as several searches ask the same in turn."""
    last = known_of(options)
    if last.get('closed') is not closed:
        rendered = _render(closed, options)
        model = read_model(rendered.xml, f'{rendered.name}.xml')
        last |= {'closed': closed, 'read': (rendered, model)}
    read: tuple[build.ModelAlone, Model] = last['read']
    return read


def _may_be_sliced(options: Options) -> bool:
    """Whoever asks for a text of his own, or for so many states, gets the whole unit."""
    return (
        options.profile is build.Profile.RCLPY
        and options.text is build.Text.COMPACT
        and options.checker is Checker.EMBEDDED
        and options.fairness is Fairness.NONE
        and options.limits.states is None
    )


def _search(
    closed: ClosedSpec,
    keys: Sequence[Key],
    limits: Limits,
    *,
    options: Options,
    progress: OnProgress | None,
) -> Found:
    """Ask some of the queries of a unit, or of a slice of one; all are open if it is too late."""
    try:
        with read_in_time(limits) as has_begun:
            watch = _also(has_begun, progress)
            return _searched(closed, keys, limits, options=options, progress=watch)
    except NotReadError:
        return unasked(
            build.queries_of(closed, profile=options.profile, max_cycle=options.max_cycle),
            keys,
            limits,
        )


def _also(has_begun: Callable[[], None], progress: OnProgress | None) -> OnProgress:
    def watch(known: Progress) -> None:
        has_begun()
        if progress is not None:
            progress(known)

    return watch


def _searched(
    closed: ClosedSpec,
    keys: Sequence[Key],
    limits: Limits,
    *,
    options: Options,
    progress: OnProgress,
) -> Found:
    rendered, model = _read(closed, options)
    wanted = set(keys)
    asked = [query for query in rendered.queries if key_of(query) in wanted]
    xml = rendered.xml.encode()
    claims = [Query(query.formula, query.words, None) for query in asked]
    whatever = [Query(q.whatever, q.words, None) for q in asked if q.whatever is not None]
    result = _check(model, xml, [*claims, *whatever], replace(options, limits=limits), progress)
    if any(answer.is_interrupted for answer in result.answers):
        raise KeyboardInterrupt  # findings need verdicts, and other units may be waiting
    teller = _Teller(model, xml, Names.of(closed.spec))
    results = {
        key_of(query): _result(answer, teller, query.family.value, query.words, query.callbacks)
        for answer, query in zip(result.answers[: len(asked)], asked, strict=True)
    }
    doubted = (query for query in asked if query.whatever is not None)
    for query, answer in zip(doubted, result.answers[len(asked) :], strict=True):
        key = key_of(query)
        results[key] = _in_spite_of_doubts(results[key], answer, teller, closed.spec)
    return Found(results, result)


def _refute(
    closed: ClosedSpec,
    keys: Sequence[Key],
    waypoints: Sequence[str],
    limits: Limits,
    *,
    options: Options,
) -> Found:
    """Look over waypoints for runs that refute some of the queries of a part."""
    search = partial(refute, waypoints=waypoints, limits=limits, engine=options.engine)
    found = _refuted(closed, keys, search, options)
    refuted = {key: each for key, each in found.results.items() if not each.in_doubt}
    return replace(found, results=refuted)


def _dive(closed: ClosedSpec, keys: Sequence[Key], limits: Limits, *, options: Options) -> Found:
    """
    Look by chance for runs that refute some of the queries.

    What was refuted only with something that is not known is in doubt, and stays so.
    """
    try:
        with read_in_time(limits):
            rendered, _ = _read(closed, options)
    except NotReadError:
        return unasked((), (), limits)
    avoided = build.IN_DOUBT if any(query.whatever for query in rendered.queries) else None
    return _refuted(closed, keys, partial(dive, limits=limits, avoided=avoided), options)


def _refuted(
    closed: ClosedSpec, keys: Sequence[Key], search: Callable[..., CheckResult], options: Options
) -> Found:
    """What of some queries a search that proves nothing refutes, or leaves in doubt."""
    rendered, model = _read(closed, options)
    wanted = set(keys)
    asked = [query for query in rendered.queries if key_of(query) in wanted]
    doubted = [query for query in asked if query.whatever is not None]
    formulas = [*(q.formula for q in asked), *(q.whatever or '' for q in doubted)]
    claims = [Query(f, q.words, None) for f, q in zip(formulas, asked + doubted, strict=True)]
    result = search(model, queries=claims)
    if any(answer.is_interrupted for answer in result.answers):
        raise KeyboardInterrupt
    teller = _Teller(model, rendered.xml.encode(), Names.of(closed.spec))
    found = {
        key_of(query): _result(answer, teller, query.family.value, query.words, query.callbacks)
        for answer, query in zip(result.answers, asked, strict=False)
    }
    for query, answer in zip(doubted, result.answers[len(asked) :], strict=True):
        known = found[key_of(query)]
        is_refuted = known.verdict is Verdict.NOT_SATISFIED
        if answer.verdict is Verdict.NOT_SATISFIED and not is_refuted:
            reason = doubts_in(teller.tell(answer), closed.spec)
            found[key_of(query)] = replace(known, reason=reason, in_doubt=True)
    refuted = {
        key: each
        for key, each in found.items()
        if each.verdict is Verdict.NOT_SATISFIED or each.in_doubt
    }
    return Found(refuted, replace(result, answers=()))


def _in_spite_of_doubts(
    result: QueryResult, whatever: Answer, teller: _Teller, spec: Spec
) -> QueryResult:
    """A claim is proven only if it holds whatever is not known."""
    if result.verdict is not Verdict.SATISFIED or whatever.verdict is Verdict.SATISFIED:
        return result
    if whatever.verdict is Verdict.UNDECIDED:
        return replace(result, verdict=Verdict.UNDECIDED, reason=whatever.reason, run=None)
    reason = doubts_in(teller.tell(whatever), spec)
    return replace(result, verdict=Verdict.UNDECIDED, reason=reason, run=None, in_doubt=True)


def _structural(closed: ClosedSpec, options: Options, shelf: Shelf) -> Iterator[QueryResult]:
    """Ask for unlimited arrivals too; the model of the unit itself bounds them."""
    is_rclpy = options.profile is build.Profile.RCLPY
    if not (is_rclpy and options.structural and options.max_cycle):
        return
    for found in structural_verdicts(closed, options.engine, options.limits, shelf):
        yield QueryResult(
            family=found.query.family.value,
            formula=found.query.formula,
            words=found.query.words,
            callbacks=found.query.callbacks,
            verdict=found.verdict,
            reason=found.reason,
            seconds=found.seconds,
            run=found.run,
        )


def _with_loads(results: tuple[QueryResult, ...], closed: ClosedSpec) -> tuple[QueryResult, ...]:
    """Beside what overload might do, say what the rates at hand do."""
    callbacks = {callback.name: callback for callback in closed.spec.callbacks}
    demands = demands_of(closed.spec)
    return tuple(
        replace(result, load=load_of(closed.spec, callbacks[result.callbacks[0]], demands))
        if result.family == build.Family.STRUCTURAL_STARVATION.value
        else result
        for result in results
    )


def _as_far_as_modelled(result: QueryResult, query: build.Query) -> QueryResult:
    """A claim that no run refutes is not proven where the model leaves out what might."""
    unrefuted = Verdict.NOT_SATISFIED if query.formula.startswith('E<>') else Verdict.SATISFIED
    if not query.left_out or result.verdict is not unrefuted:
        return result
    reason = f'the model leaves out {", ".join(query.left_out)}'
    return replace(result, verdict=Verdict.UNDECIDED, reason=reason, run=None)


def _caveats(closed: ClosedSpec, options: Options, found: Found) -> tuple[str, ...]:
    notes = []
    if found.by_slices:
        notes.append(f'{found.by_slices} verdicts are from slices of the unit')
    if options.max_cycle is None:
        notes.append(f'arrivals without bound; fairness of a run: {options.fairness.value}')
    notes.extend(caveats_of(closed.spec, options.profile))
    return tuple(notes)


def ask_unit(
    closed: ClosedSpec,
    queries: Sequence[Query],
    options: Options = Options(),
    progress: OnProgress | None = None,
) -> Verification:
    """
    Ask other queries than its own of a unit.

    They are asked of the plain text, whatever the options say: the compact text keeps only what
    its own queries can see.
    """
    options = replace(options, limits=options.limits.begun())
    with limited_reading(options.limits, Path(closed.spec.name)) as has_begun:
        rendered = build.render_alone(
            closed, profile=options.profile, text=build.Text.PLAIN, max_cycle=options.max_cycle
        )
        model = read_model(rendered.xml, f'{rendered.name}.xml')
        names, watch = Names.of(closed.spec), _also(has_begun, progress)
        found = _asked(model, rendered.xml.encode(), queries, options, watch, names)
    return replace(
        found,
        model=rendered.name,
        profile=options.profile.value,
        text=build.Text.PLAIN.value,
        assumptions=closed.assumptions,
    )


def verify_model(
    path: Path,
    queries: Sequence[Query] = (),
    options: Options = Options(),
    progress: OnProgress | None = None,
) -> Verification:
    """
    Check a model file, by the queries given or by those in the model.

    :raises InputError: when there is no query, or the file cannot be read, also not in time.
    :raises ModelFormatError: when it is outside our subset; verifyta takes it all the same.
    """
    options = replace(options, limits=options.limits.begun())
    with limited_reading(options.limits, path) as has_begun:
        return _verify_model(path, queries, options, _also(has_begun, progress))


def _verify_model(
    path: Path, queries: Sequence[Query], options: Options, progress: OnProgress
) -> Verification:
    try:
        model = load_model(path)
    except ModelFormatError as error:
        if options.checker is not Checker.VERIFYTA or not queries:
            raise
        return _verify_unread(path, queries, options, error)
    queries = queries or model.queries
    if not queries:
        place = Place(str(path))
        raise InputError('no query found', place, 'name a .q file after the model, or use --query')
    return replace(
        _asked(model, model_text(path), queries, options, progress, Names()), model=path.name
    )


def _verify_unread(
    path: Path, queries: Sequence[Query], options: Options, error: ModelFormatError
) -> Verification:
    """Have verifyta check what only it can read; no run is shown, as none can be replayed."""
    result = _ask_verifyta(None, model_text(path), queries, options)
    results = tuple(
        QueryResult(
            family=None,
            formula=answer.query.formula,
            words=answer.query.comment or answer.query.formula,
            callbacks=(),
            verdict=answer.verdict,
            reason=answer.reason,
            seconds=answer.seconds,
            run=None,
        )
        for answer in result.answers
    )
    note = f'{error}; so no run could be replayed'
    return _verification(path.name, result, results, notes=(note,))


def _asked(
    model: Model,
    xml: bytes,
    queries: Sequence[Query],
    options: Options,
    progress: OnProgress | None,
    names: Names,
) -> Verification:
    result = _check(model, xml, queries, options, progress)
    teller = _Teller(model, xml, names)
    results = tuple(
        _result(answer, teller, None, answer.query.comment or answer.query.formula, ())
        for answer in result.answers
    )
    return _verification(model.name, result, results)


def _check(
    model: Model,
    xml: bytes,
    queries: Sequence[Query],
    options: Options,
    progress: OnProgress | None,
) -> CheckResult:
    note = ''
    if options.checker is Checker.VERIFYTA:
        try:
            return _ask_verifyta(model, xml, queries, options)
        except LicenceError as error:
            note = f'{error}; the embedded checker was used'
    result = check(
        model,
        queries,
        limits=options.limits,
        engine=options.engine,
        fairness=options.fairness,
        reduction=options.reduction,
        progress=progress,
        jobs=options.jobs,
    )
    return replace(result, note='; '.join(filter(None, (note, result.note))))


def _ask_verifyta(
    model: Model | None, xml: bytes, queries: Sequence[Query], options: Options
) -> CheckResult:
    return check_by_verifyta(
        model,
        xml,
        queries,
        program=find_verifyta(options.verifyta),
        runs=options.runs,
        fairness=options.fairness,
        seconds=options.limits.seconds_left,
    )


def load_queries(path: Path) -> tuple[Query, ...]:
    """
    Read a query file.

    :raises InputError: when it cannot be read or holds no query.
    """
    try:
        text = read_named(path, MOST_MODEL_BYTES).decode('utf-8')
    except UnicodeDecodeError:
        raise InputError('no UTF-8 text', Place(str(path)), 'is this a .q file?') from None
    return read_queries(text, str(path))


@dataclass(frozen=True)
class _Teller:
    """Tells the runs of one model."""

    model: Model
    xml: bytes
    names: Names

    def tell(self, answer: Answer) -> Evidence:
        run = answer.path
        assert run is not None, 'only asked of answers that have a run'
        return replace(tell(run, self.names), origin=UppaalRun(self.model, self.xml, run))


def _result(
    answer: Answer, teller: _Teller, family: str | None, words: str, callbacks: tuple[str, ...]
) -> QueryResult:
    return QueryResult(
        family=family,
        formula=answer.query.formula,
        words=words,
        callbacks=callbacks,
        verdict=answer.verdict,
        reason=answer.reason,
        seconds=answer.seconds,
        run=partial(teller.tell, answer) if answer.replay else None,
    )


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
