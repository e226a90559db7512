"""
Structural starvation: can others keep a callback from running for ever, however fair threads are?

Asked callback by callback, of a slice of the unit. Whoever starves in a slice starves in the
unit: there the others may just get no data. And the slice holds the rivals that matter
(docs/profile-rclpy.md, *Slices*).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

from ros2cc_extract.checker.api import (
    Answer,
    EngineKind,
    Fairness,
    Limits,
    Query,
    Verdict,
    check,
    read_model,
)
from ros2cc_extract.generator import build
from ros2cc_extract.generator.queries import structural_starvation
from ros2cc_extract.generator.serving import executor_kind, rank_of
from ros2cc_extract.generator.unit import number_unit
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import Callback, Spec
from ros2cc_extract.verify.evidence import Evidence, Names, tell
from ros2cc_extract.verify.load import served_before

#: The member of a group that is served first starves by two others, not by one.
RIVALS = 2
#: From this rank on nodes are served one after the other; tasks and waitables of all come first.
OF_NODES = 2
Shape = tuple[object, ...]


@dataclass(frozen=True)
class Structural:
    """
    The verdict on one callback.

    :param query: as asked of the whole unit without a bound on arrivals.
    :param run: finds the run behind the verdict, where there is one.
    """

    query: build.Query
    verdict: Verdict
    reason: str | None
    seconds: float
    run: Callable[[], Evidence] | None


def structural_verdicts(
    closed: ClosedSpec, engine: EngineKind, limits: Limits
) -> Iterator[Structural]:
    """Ask for every callback, in the order of the unit; slices of one shape are asked once."""
    unit = number_unit(closed, None)
    known: dict[Shape, Answer] = {}
    for callback, numbered in zip(closed.spec.callbacks, unit.callbacks, strict=True):
        part = slice_for(callback, closed)
        shape = _shape(part.spec, callback)
        answer = known.get(shape)
        seconds = 0.0
        if answer is None and limits.deadline is not None and limits.is_over:
            reason = limits.deadline.reason
            query = structural_starvation(numbered)
            yield Structural(query, Verdict.UNDECIDED, reason, 0.0, None)
            continue
        if answer is None:
            answer = known[shape] = _ask(part, callback.name, engine, limits)
            seconds = answer.seconds
        starves = answer.verdict is Verdict.NOT_SATISFIED
        yield Structural(
            structural_starvation(numbered),
            answer.verdict,
            answer.reason,
            seconds,
            partial(_tell, part, callback.name, engine, limits) if starves else None,
        )


def slice_for(callback: Callback, closed: ClosedSpec) -> ClosedSpec:
    """
    Keep a callback and its rivals: members of its group, the last served before it first.

    Its waits are left out: whether whoever waits comes to an end is a question of its own.
    """
    spec = closed.spec
    earlier = served_before(callback, spec)[::-1]
    mates = [c for c in spec.callbacks if c.group == callback.group and c not in earlier]
    strangers = [c for c in spec.callbacks if c.group != callback.group]
    others = [c for c in (*earlier, *mates, *strangers) if c != callback]
    kept = {callback.name, *(c.name for c in others[:RIVALS])}
    callbacks = tuple(replace(c, blocking=()) for c in spec.callbacks if c.name in kept)
    groups = {c.group for c in callbacks}
    threads = spec.executor.threads[: len(callbacks)]
    return replace(
        closed,
        spec=replace(
            spec,
            callbacks=callbacks,
            groups=tuple(group for group in spec.groups if group.name in groups),
            executor=replace(spec.executor, threads=threads),
            unresolved=(),
        ),
    )


def _shape(part: Spec, callback: Callback) -> Shape:
    """
    What the model depends on: two slices of one shape have one verdict.

    Without waits a type says no more than the order of serving, and that kind by kind.
    """
    ranks = sorted({rank_of(c) for c in part.callbacks})
    nodes = list(dict.fromkeys(c.node for c in part.callbacks))
    groups = list(dict.fromkeys(c.group for c in part.callbacks))
    return (
        executor_kind(part),
        len(part.executor.threads),
        tuple(part.group_of(next(c for c in part.callbacks if c.group == g)).type for g in groups),
        tuple(
            (
                min(rank_of(c), OF_NODES),
                ranks.index(rank_of(c)),
                nodes.index(c.node),
                groups.index(c.group),
                c.name == callback.name,
            )
            for c in part.callbacks
        ),
    )


def _ask(part: ClosedSpec, name: str, engine: EngineKind, limits: Limits) -> Answer:
    rendered = build.render(
        part, profile=build.Profile.RCLPY, text=build.Text.COMPACT, max_cycle=None
    )
    asked = next(
        query
        for query in rendered.queries
        if query.family is build.Family.STARVATION and query.callbacks == (name,)
    )
    result = check(
        read_model(rendered.xml, f'{rendered.name}.xml'),
        [Query(asked.formula, asked.words, None)],
        limits=limits,
        engine=engine,
        fairness=Fairness.WEAK,
        reduction=False,
    )
    if result.answers[0].is_interrupted:
        raise KeyboardInterrupt  # many more would be asked
    return result.answers[0]


def _tell(part: ClosedSpec, name: str, engine: EngineKind, limits: Limits) -> Evidence:
    run = _ask(part, name, engine, limits).path
    assert run is not None, 'only asked of callbacks that starve'
    return tell(run, Names.of(part.spec))
