"""What an engine is asked and what it answers, the same for every engine."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import Protocol

from ros2cc_extract.checker.engines.terms import Verdict
from ros2cc_extract.checker.network.arithmetic import negation
from ros2cc_extract.checker.network.network import Expr, Property, QueryKind
from ros2cc_extract.checker.network.semantics import Edges, State
from ros2cc_extract.light_dataclasses import dataclass


class End(Enum):
    """How a maximal path ends that does not go round a cycle."""

    DEADLOCK = 'deadlock'
    IDLE = 'idle'


class Symmetry(Enum):
    """When states are merged that differ only in which of several like processes does what."""

    NEVER = 'never'
    WHEN_LARGE = 'when large'
    ALWAYS = 'always'


@dataclass(frozen=True, kw_only=True)
class Reductions:
    """
    What a search may leave out, as no verdict depends on it.

    :param dead: values that are written before they are read again.
    :param chains: states with a committed location are run through and not stored, if all
        properties are of reachability.
    """

    dead: bool = True
    symmetry: Symmetry = Symmetry.WHEN_LARGE
    chains: bool = True


NO_REDUCTIONS = Reductions(dead=False, symmetry=Symmetry.NEVER, chains=False)


class Reduce(Protocol):
    """What a search does to a state that was reached by some edges, before it stores it."""

    def forget(self, state: State, edges: Edges) -> State:
        """Return the state without what is forgotten where the edges lead."""
        ...

    def canonical(self, state: State) -> State:
        """Return the state that stands for all that are like it."""
        ...


INTERRUPTED = 'interrupted'


@dataclass(frozen=True)
class StatePath:
    """
    States of a witness or counterexample, the initial one first.

    :param cycle_start: index of the state to which the last one leads back; None without cycle.
    :param end: set on maximal paths without cycle.
    """

    states: tuple[State, ...]
    cycle_start: int | None = None
    end: End | None = None


@dataclass(frozen=True)
class Outcome:
    """Answer to one property; ``path`` is there where a state or path decided it."""

    verdict: Verdict
    seconds: float
    path: StatePath | None = None
    reason: str | None = None


@dataclass(frozen=True)
class SearchResult:
    """
    Answers to all properties of one exploration.

    :param complete: whether every reachable state was explored.
    :param reduce: how the states of the paths came from those of the model; None: as they are.
    """

    states: int
    transitions: int
    seconds: float
    complete: bool
    outcomes: tuple[Outcome, ...]
    reduce: Reduce | None = None


def refutes(kind: QueryKind) -> bool:
    """Whether a path that is found makes the answer *not satisfied*."""
    return kind in (QueryKind.INVARIANT, QueryKind.EVENTUALLY, QueryKind.LEADS_TO)


def goal_of(prop: Property) -> Expr:
    """Return what a state must fulfil to decide an invariant or a reachability query."""
    return prop.formula if prop.kind is QueryKind.REACHABLE else negation(prop.formula)


def inside_of(prop: Property) -> Expr:
    """Return what all states of a lasso must fulfil to decide a liveness query."""
    return prop.formula if prop.kind is QueryKind.POSSIBLY_ALWAYS else negation(prop.formula)


def formulas_of(properties: Sequence[Property]) -> list[Expr]:
    """Return all state formulae, whose values a reduction must keep."""
    formulas = [prop.formula for prop in properties]
    return formulas + [prop.premise for prop in properties if prop.premise is not None]


def is_reachability(prop: Property) -> bool:
    """Whether a single state decides the property."""
    return prop.kind in (QueryKind.INVARIANT, QueryKind.REACHABLE)


def found(prop: Property, seconds: float, path: StatePath) -> Outcome:
    """Return the answer when a path was found."""
    verdict = Verdict.NOT_SATISFIED if refutes(prop.kind) else Verdict.SATISFIED
    return Outcome(verdict, seconds, path)


def not_found(prop: Property, seconds: float, reason: str | None) -> Outcome:
    """Return the answer when no path was found; ``reason`` says why the search was cut short."""
    if reason:
        return Outcome(Verdict.UNDECIDED, seconds, reason=reason)
    return Outcome(Verdict.SATISFIED if refutes(prop.kind) else Verdict.NOT_SATISFIED, seconds)


def positions(properties: Sequence[Property], reachability: bool) -> list[int]:
    """Return the indices of the properties of one sort."""
    return [i for i, prop in enumerate(properties) if is_reachability(prop) is reachability]
