"""
Asks a checker about one model: exactly, or by searches that refute and prove nothing.

Every run that is handed on was replayed by the checker.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

from ros2cc_extract.checker.api import (
    Answer,
    CheckResult,
    Limits,
    Model,
    Progress,
    Query,
    Verdict,
    check,
    read_model,
)
from ros2cc_extract.checker.refutation.random_runs import dive
from ros2cc_extract.checker.refutation.waypoints import refute
from ros2cc_extract.generator import build
from ros2cc_extract.identity_memo import known_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.evidence import Evidence
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.results.run_evidence import Names, describe
from ros2cc_extract.verify.results.undecided_reasons import doubts_in
from ros2cc_extract.verify.search.options import Checker, OnProgress, Options
from ros2cc_extract.verify.search.reading_deadline import NotReadError, read_in_time
from ros2cc_extract.verify.search.search_results import Found, Key, key_of, unasked
from ros2cc_extract.verify.uppaal.run import UppaalRun
from ros2cc_extract.verify.uppaal.verifyta import LicenceError, find_verifyta
from ros2cc_extract.verify.uppaal.verifyta_check import check_by_verifyta


def _read(closed: ClosedSpec, options: Options) -> tuple[build.ModelAlone, Model]:
    """Render and read; the last one is kept, as several searches ask the same in turn."""
    last = known_of(options)
    if last.get('closed') is not closed:
        rendered = build.render_alone(
            closed, profile=options.profile, text=options.text, max_cycle=options.max_cycle
        )
        model = read_model(rendered.xml, f'{rendered.name}.xml')
        last |= {'closed': closed, 'read': (rendered, model)}
    read: tuple[build.ModelAlone, Model] = last['read']
    return read


def search(
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
            watch = also_begun(has_begun, progress)
            return _searched(closed, keys, limits, options=options, progress=watch)
    except NotReadError:
        return unasked(
            build.queries_of(closed, profile=options.profile, max_cycle=options.max_cycle),
            keys,
            limits,
        )


def also_begun(has_begun: Callable[[], None], progress: OnProgress | None) -> OnProgress:
    """Say of the first progress that the search has begun, and hand all of it on."""

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
    result = check_queries(
        model, xml, [*claims, *whatever], replace(options, limits=limits), progress
    )
    if any(answer.is_interrupted for answer in result.answers):
        raise KeyboardInterrupt  # findings need verdicts, and other units may be waiting
    describer = RunDescriber(model, xml, Names.of(closed.spec))
    results = {
        key_of(query): result_of(
            answer, describer, query.family.value, query.words, query.callbacks
        )
        for answer, query in zip(result.answers[: len(asked)], asked, strict=True)
    }
    doubted = (query for query in asked if query.whatever is not None)
    for query, answer in zip(doubted, result.answers[len(asked) :], strict=True):
        key = key_of(query)
        results[key] = _in_spite_of_doubts(results[key], answer, describer, closed.spec)
    return Found(results, result)


def refute_over_waypoints(
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


def refute_by_chance(
    closed: ClosedSpec, keys: Sequence[Key], limits: Limits, *, options: Options
) -> Found:
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
    describer = RunDescriber(model, rendered.xml.encode(), Names.of(closed.spec))
    found = {
        key_of(query): result_of(
            answer, describer, query.family.value, query.words, query.callbacks
        )
        for answer, query in zip(result.answers, asked, strict=False)
    }
    for query, answer in zip(doubted, result.answers[len(asked) :], strict=True):
        known = found[key_of(query)]
        is_refuted = known.verdict is Verdict.NOT_SATISFIED
        if answer.verdict is Verdict.NOT_SATISFIED and not is_refuted:
            reason = doubts_in(describer.describe(answer), closed.spec)
            found[key_of(query)] = replace(known, reason=reason, in_doubt=True)
    refuted = {
        key: each
        for key, each in found.items()
        if each.verdict is Verdict.NOT_SATISFIED or each.in_doubt
    }
    return Found(refuted, replace(result, answers=()))


def _in_spite_of_doubts(
    result: QueryResult, whatever: Answer, describer: RunDescriber, spec: Spec
) -> QueryResult:
    """A claim is proven only if it holds for any value of what is not known."""
    if result.verdict is not Verdict.SATISFIED or whatever.verdict is Verdict.SATISFIED:
        return result
    if whatever.verdict is Verdict.UNDECIDED:
        return replace(result, verdict=Verdict.UNDECIDED, reason=whatever.reason, run=None)
    reason = doubts_in(describer.describe(whatever), spec)
    return replace(result, verdict=Verdict.UNDECIDED, reason=reason, run=None, in_doubt=True)


def check_queries(
    model: Model,
    xml: bytes,
    queries: Sequence[Query],
    options: Options,
    progress: OnProgress | None,
) -> CheckResult:
    """Have the checker that is asked for answer ``queries`` of a model whose text is ``xml``."""
    note = ''
    if options.checker is Checker.VERIFYTA:
        try:
            return ask_verifyta(model, xml, queries, options)
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


def ask_verifyta(
    model: Model | None, xml: bytes, queries: Sequence[Query], options: Options
) -> CheckResult:
    """Have verifyta answer; without ``model`` no run can be replayed, and none is shown."""
    return check_by_verifyta(
        model,
        xml,
        queries,
        program=find_verifyta(options.verifyta),
        runs=options.runs,
        fairness=options.fairness,
        seconds=options.limits.seconds_left,
    )


@dataclass(frozen=True)
class RunDescriber:
    """Describes the runs of one model."""

    model: Model
    xml: bytes
    names: Names

    def describe(self, answer: Answer) -> Evidence:
        """Replay the run of an answer, and put it into words."""
        run = answer.path
        assert run is not None, 'only asked of answers that have a run'
        return replace(describe(run, self.names), origin=UppaalRun(self.model, self.xml, run))


def result_of(
    answer: Answer,
    describer: RunDescriber,
    family: str | None,
    words: str,
    callbacks: tuple[str, ...],
) -> QueryResult:
    """Tie an answer to its words, and to the run that shows it."""
    return QueryResult(
        family=family,
        formula=answer.query.formula,
        words=words,
        callbacks=callbacks,
        verdict=answer.verdict,
        reason=answer.reason,
        seconds=answer.seconds,
        run=partial(describer.describe, answer) if answer.replay else None,
    )
