"""
Structural starvation: can others keep a callback from running forever, however fair threads are?

Asked callback by callback, of a slice of the unit. What starves in a slice starves in the
unit: there the others may just get no data. And the slice holds the rivals that matter
(docs/profile-rclpy.md, *Slices*).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

from ros2cc_extract.checker.api import (
    CheckResult,
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
from ros2cc_extract.generator.unit import number_unit
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import Callback
from ros2cc_extract.verify.results.evidence import LOST, Evidence
from ros2cc_extract.verify.results.load import served_before
from ros2cc_extract.verify.results.run_evidence import Names, describe
from ros2cc_extract.verify.search.known_answers import Answered, Entry, Role, Shelf
from ros2cc_extract.verify.slices.slice_shapes import outline_of

#: The member of a group that is served first starves by two others, not by one.
RIVALS = 2


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
    closed: ClosedSpec, engine: EngineKind, limits: Limits, shelf: Shelf | None = None
) -> Iterator[Structural]:
    """Ask for every callback, in the order of the unit; slices of one shape are asked once."""
    shelf = Shelf() if shelf is None else shelf
    numbered = number_unit(closed, None).callbacks
    for callback, of_unit in zip(closed.spec.callbacks, numbered, strict=True):
        part = slice_for(callback, closed)
        if limits.deadline is not None and limits.is_over:
            query = structural_starvation(of_unit)
            yield Structural(query, Verdict.UNDECIDED, limits.deadline.reason, 0.0, None)
            continue
        outline = outline_of(part, None)
        role = (
            build.Family.STRUCTURAL_STARVATION.value,
            (outline.callbacks.index(callback.name),),
            (),
        )
        ask = partial(_entry, part, callback.name, role, engine, limits)
        known = shelf.take((outline.shape, role), ask).answers[role]
        yield Structural(
            structural_starvation(of_unit),
            known.verdict,
            known.reason,
            known.seconds,
            partial(_described, part, callback.name, engine, limits) if known.has_run else None,
        )


def _entry(part: ClosedSpec, name: str, role: Role, engine: EngineKind, limits: Limits) -> Entry:
    found = _ask(part, name, engine, limits)
    answer = found.answers[0]
    has_run = answer.verdict is Verdict.NOT_SATISFIED
    known = Answered(answer.verdict, answer.reason, answer.seconds, has_run)
    return Entry({role: known}, replace(found, answers=()))


def slice_for(callback: Callback, closed: ClosedSpec) -> ClosedSpec:
    """
    Keep a callback and its rivals: members of its group, the last served before it first.

    Its waits are left out: whether a waiting callback comes to an end is a question of its own.
    """
    spec = closed.spec
    earlier = served_before(callback, spec)[::-1]
    before = {c.name for c in earlier}
    mates = [c for c in spec.callbacks if c.group == callback.group and c.name not in before]
    strangers = [c for c in spec.callbacks if c.group != callback.group]
    others = [c for c in (*earlier, *mates, *strangers) if c.name != callback.name]
    kept = {callback.name, *(c.name for c in others[:RIVALS])}
    callbacks = tuple(replace(c, blocking=()) for c in spec.callbacks if c.name in kept)
    groups = {c.group for c in callbacks}
    threads = spec.executor.threads[: len(callbacks)]
    return replace(
        closed,
        spec=replace(
            spec,
            callbacks=callbacks,
            activities=(),
            groups=tuple(group for group in spec.groups if group.name in groups),
            executor=replace(spec.executor, threads=threads),
            unresolved=(),
        ),
    )


def _ask(part: ClosedSpec, name: str, engine: EngineKind, limits: Limits) -> CheckResult:
    rendered = build.render_alone(
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
    return result


def _described(part: ClosedSpec, name: str, engine: EngineKind, limits: Limits) -> Evidence:
    run = _ask(part, name, engine, limits).answers[0].path
    return LOST if run is None else describe(run, Names.of(part.spec))
