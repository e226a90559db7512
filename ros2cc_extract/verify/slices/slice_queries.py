"""
Ask slices: each shape of slice once, under any names.

A small slice is asked all that can be asked of it, so that one reading of its model answers for
every unit that has a slice of its shape.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import field, replace
from functools import partial

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Profile, Query, queries_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.results.evidence import Evidence
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.search.known_answers import Answered, Entry, Role, Shelf
from ros2cc_extract.verify.search.search_results import (
    SLICE_STATES,
    Found,
    Key,
    Search,
    key_of,
    total,
    weighs_more,
)
from ros2cc_extract.verify.slices.slice_shapes import Outline, Shape
from ros2cc_extract.verify.slices.slicer import Slicer
from ros2cc_extract.verify.slices.wait_relations import Names

#: A slice of up to so many callbacks is asked everything.
ASKED_IN_FULL = 3


@dataclass(frozen=True)
class _Question:
    """One query, asked of one slice."""

    query: Query
    names: Names
    outline: Outline

    @property
    def role(self) -> Role:
        return _role(key_of(self.query), self.outline)


def _role(key: Key, outline: Outline) -> Role:
    """
    The query by places in the shape.

    Whichever of two callbacks is named first, the question is the same.
    """
    family, callbacks, groups = key
    return (
        family.value,
        tuple(sorted(map(outline.callbacks.index, callbacks))),
        tuple(map(outline.groups.index, groups)),
    )


@dataclass(frozen=True)
class Slicing:
    """
    Slices of one unit, and what asks them.

    :param shelf: answers for shapes, of this unit and of others.
    """

    slicer: Slicer
    search: Search
    limits: Limits
    shelf: Shelf
    _parts: dict[Names, ClosedSpec] = field(default_factory=dict)

    def decide(self, queries: Iterable[Query]) -> Found | None:
        """Ask every slice of ``queries``; ``None`` where none of them has any."""
        asked: dict[Shape, list[_Question]] = {}
        outlines: dict[Names, Outline | None] = {}
        for query in queries:
            if self.limits.is_over:
                break
            for names in self._slices(query):
                if names not in outlines:
                    outlines[names] = self.slicer.outline(names)
                found = outlines[names]
                if found is not None:
                    asked.setdefault(found.shape, []).append(_Question(query, names, found))
        results: dict[Key, QueryResult] = {}
        checks = []
        for questions in asked.values():
            if not self.limits.is_over:
                entry, answered = self._entry(questions)
                checks.append(entry.check)
                self._add(results, questions, entry, answered)
        if not checks:
            return None
        by_slices = sum(result.verdict is not Verdict.UNDECIDED for result in results.values())
        return Found(results, total(checks), by_slices)

    def _slices(self, query: Query) -> Iterator[Names]:
        names = self.slicer.slice_for(query)
        if names is not None and len(names) < len(self.slicer.closed.spec.callbacks):
            yield names

    def _part(self, names: Names) -> ClosedSpec:
        if names not in self._parts:
            self._parts[names] = self.slicer.cut(names)
        return self._parts[names]

    def _entry(self, questions: Sequence[_Question]) -> tuple[Entry, dict[Role, QueryResult]]:
        """What is known of a shape, and the results of its search if there was one."""
        first = questions[0]
        in_full = len(first.names) <= ASKED_IN_FULL
        asked = None if in_full else frozenset(question.role for question in questions)
        answered: dict[Role, QueryResult] = {}

        def ask() -> Entry:
            part = self._part(first.names)
            every = queries_of(part, profile=Profile.RCLPY, max_cycle=self.slicer.max_cycle)
            keys = {_role(key_of(query), first.outline): key_of(query) for query in every}
            keys = {role: key for role, key in keys.items() if asked is None or role in asked}
            limits = replace(self.limits, states=SLICE_STATES)
            found = self.search(part, list(keys.values()), limits)
            answered.update({role: found.results[key] for role, key in keys.items()})
            known = {role: _answered(result) for role, result in answered.items()}
            return Entry(known, replace(found.check, answers=()))

        what = None if asked is None else tuple(sorted(asked))
        return self.shelf.take((first.outline.shape, what), ask), answered

    def _add(
        self,
        results: dict[Key, QueryResult],
        questions: Sequence[_Question],
        entry: Entry,
        answered: dict[Role, QueryResult],
    ) -> None:
        names = questions[0].names
        for question in questions:
            role, key = question.role, key_of(question.query)
            if role not in entry.answers:
                continue  # the slice knows no such query: the whole unit is asked
            own = answered.get(role) if question.names == names else None
            result = own or self._result(question, entry.answers[role])
            if key not in results or weighs_more(result, results[key]):
                results[key] = result

    def _result(self, question: _Question, known: Answered) -> QueryResult:
        query = question.query
        return QueryResult(
            family=query.family.value,
            formula=query.formula,
            words=query.words,
            callbacks=query.callbacks,
            verdict=known.verdict,
            reason=known.reason,
            seconds=known.seconds,
            run=partial(self._evidence, question) if known.has_run else None,
            in_doubt=known.in_doubt,
        )

    def _evidence(self, question: _Question) -> Evidence:
        """Find the run of a slice if another one of its shape was asked."""
        key = key_of(question.query)
        found = self.search(self._part(question.names), [key], Limits())
        evidence = found.results[key].evidence
        assert evidence is not None, 'only asked of results that have a run'
        return evidence


def _answered(result: QueryResult) -> Answered:
    has_run = result.run is not None
    return Answered(result.verdict, result.reason, result.seconds, has_run, result.in_doubt)
