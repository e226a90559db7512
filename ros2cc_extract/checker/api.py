"""The public door of the checker: read a model, read queries, check."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from ros2cc_extract.checker.engines.choice import Engine, choose
from ros2cc_extract.checker.engines.limits import Limits, Progress, peak_mb
from ros2cc_extract.checker.engines.search import NO_REDUCTIONS, Reductions
from ros2cc_extract.checker.engines.terms import EngineKind, Fairness, Verdict
from ros2cc_extract.checker.network.network import Property
from ros2cc_extract.checker.runs.answers import Answer, CheckResult
from ros2cc_extract.checker.runs.complementary_queries import twins_of, with_twins
from ros2cc_extract.checker.runs.replay import Replayer
from ros2cc_extract.checker.runs.run import EdgeRef, Run, StateView, Step
from ros2cc_extract.checker.uppaal.files.query_file import Query
from ros2cc_extract.checker.uppaal.model import (
    Model,
    load_model,
    model_text,
    read_model,
    read_queries,
    too_deep,
)
from ros2cc_extract.source_locations import Place

__all__ = [
    'Answer',
    'CheckResult',
    'EdgeRef',
    'EngineKind',
    'Fairness',
    'Limits',
    'Model',
    'Progress',
    'Query',
    'Reductions',
    'Run',
    'StateView',
    'Step',
    'Verdict',
    'check',
    'load_model',
    'model_text',
    'read_model',
    'read_queries',
]


def check(
    model: Model,
    queries: Sequence[Query],
    *,
    limits: Limits = Limits(),  # noqa: B008 - frozen value
    engine: EngineKind = EngineKind.AUTO,
    fairness: Fairness = Fairness.NONE,
    reduction: bool | Reductions = True,
    progress: Callable[[Progress], None] | None = None,
    jobs: int = 1,
) -> CheckResult:
    """
    Answer all queries by one exploration.

    :param reduction: explore fewer states where that keeps all verdicts.
    :param jobs: threads that explore together; the answer does not depend on them.
    :raises ModelFormatError: a query is wrong, or a reachable state breaks a range.
    :raises ToolNotFoundError: the native core was asked for and is not built.
    :raises CoreMismatchError: a path of a reduced search could not be replayed (a defect).
    """
    if isinstance(reduction, bool):
        reduction = Reductions() if reduction else NO_REDUCTIONS
    try:
        return _check(model, queries, limits, engine, fairness, reduction, progress, jobs)
    except RecursionError:
        raise too_deep(model.name) from None


def _properties(model: Model, queries: Sequence[Query], limits: Limits) -> list[Property] | None:
    """Read all queries, which a large unit has by the hundred thousand; None: the time is over."""
    unnamed = Place('query', 1)
    properties = []
    for query in queries:
        if limits.is_over:
            return None
        properties.append(model.elaboration.query(query.formula, query.place or unnamed))
    return properties


def _unsearched(queries: Sequence[Query], limits: Limits, engine: Engine) -> CheckResult:
    reason = limits.deadline.reason if limits.deadline else None
    return CheckResult(
        engine=engine.name,
        states=0,
        transitions=0,
        seconds=0.0,
        peak_mb=peak_mb(),
        complete=False,
        answers=tuple(
            Answer(query=query, verdict=Verdict.UNDECIDED, reason=reason, seconds=0.0, replay=None)
            for query in queries
        ),
    )


def _check(
    model: Model,
    queries: Sequence[Query],
    limits: Limits,
    engine: EngineKind,
    fairness: Fairness,
    reductions: Reductions,
    progress: Callable[[Progress], None] | None,
    jobs: int,
) -> CheckResult:
    chosen = choose(engine)
    twins = twins_of([query.formula for query in queries])
    asked = [query for number, query in enumerate(queries) if number not in twins]
    properties = _properties(model, asked, limits)
    if properties is None:
        return _unsearched(queries, limits, chosen)
    network = model.network
    result = chosen.search(
        network,
        properties,
        limits=limits,
        fairness=fairness,
        reductions=reductions,
        progress=progress,
        jobs=jobs,
    )
    replayer = Replayer(model.elaboration, network, fairness)
    reported = [
        Answer(
            query=query,
            verdict=outcome.verdict,
            reason=outcome.reason,
            seconds=outcome.seconds,
            replay=partial(replayer.run, prop, outcome.path, result.reduce)
            if outcome.path
            else None,
        )
        for query, prop, outcome in zip(asked, properties, result.outcomes, strict=True)
    ]
    answers = with_twins(queries, reported, twins)
    if result.reduce is not None:
        for answer in answers:
            _ = answer.path  # a reduction that goes wrong must fail before its verdict is seen
    return CheckResult(
        engine=chosen.name,
        states=result.states,
        transitions=result.transitions,
        seconds=result.seconds,
        peak_mb=peak_mb(),
        complete=result.complete,
        answers=answers,
    )
