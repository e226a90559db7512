"""How much of a specification was found out: resolved, assumed by a rule, or unresolved."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from enum import Enum

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Executor, Spec, Unresolved

DEFAULT_COUNT = 'default_cpu_count'


class Subject(Enum):
    """What facts are about."""

    CALLBACKS = 'callbacks'
    GROUPS = 'groups'
    THREAD_COUNTS = 'thread counts'
    OWNERSHIPS = 'ownerships'


@dataclass(frozen=True)
class Confidence:
    """
    Counts for one subject.

    :param assumed: the rule by which a fact was assumed, with the number of such facts.
    """

    resolved: int = 0
    assumed: Mapping[str, int] = field(default_factory=dict)
    unresolved: int = 0

    @property
    def total(self) -> int:
        """All facts."""
        return self.resolved + sum(self.assumed.values()) + self.unresolved


@dataclass(frozen=True)
class Summary:
    """
    The confidence in several units.

    :param open: every unresolved fact, with its reason and place, in the order of the units.
    """

    of: Mapping[Subject, Confidence]
    open: tuple[Unresolved, ...]


_RESOLVED = 'resolved'


def confidence_in(units: Iterable[Spec]) -> Summary:
    """Count what is known in ``units``; entities that rclpy makes by itself do not count."""
    specs = list(units)
    of = {
        subject: _counted(state for spec in specs for state in states(spec))
        for subject, states in _STATES.items()
    }
    return Summary(of, tuple(fact for spec in specs for fact in spec.unresolved))


def _counted(states: Iterable[str | Unknown]) -> Confidence:
    """Sum up states: ``_RESOLVED``, the rule of an assumption, or why it is not known."""
    resolved, unresolved, assumed = 0, 0, Counter[str]()
    for state in states:
        if isinstance(state, Unknown):
            unresolved += 1
        elif state == _RESOLVED:
            resolved += 1
        else:
            assumed[state] += 1
    return Confidence(resolved, dict(sorted(assumed.items())), unresolved)


def _callbacks(spec: Spec) -> Iterator[str | Unknown]:
    """A callback is resolved when its function, key, period and number are."""
    for callback in spec.callbacks:
        if not callback.builtin:
            facts = (callback.unresolved, callback.key, callback.period_s, callback.count)
            unknown = next((fact for fact in facts if isinstance(fact, Unknown)), None)
            yield unknown or callback.assumed or _RESOLVED


def _groups(spec: Spec) -> Iterator[str | Unknown]:
    used = {callback.group for callback in spec.callbacks if not callback.builtin}
    for group in spec.groups:
        if group.name in used and not group.groupless:
            yield group.unresolved or group.assumed or _RESOLVED


def _thread_counts(spec: Spec) -> Iterator[str | Unknown]:
    executor = spec.executor
    if isinstance(executor.kind, Unknown):
        yield executor.kind
    elif executor.unresolved is not None:
        yield executor.unresolved
    else:
        yield _thread_rule(executor)


def _thread_rule(executor: Executor) -> str:
    if executor.assumed:
        return executor.assumed
    is_default = executor.threads_source == DEFAULT_COUNT
    return 'as many threads as CPUs' if is_default else _RESOLVED


def _ownerships(spec: Spec) -> Iterator[str | Unknown]:
    """Which node a callback belongs to, and which executor serves it."""
    for callback in spec.callbacks:
        if not callback.builtin:
            facts = (callback.node, spec.executor.kind)
            unknown = next((fact for fact in facts if isinstance(fact, Unknown)), None)
            yield unknown or _RESOLVED


_STATES = {
    Subject.CALLBACKS: _callbacks,
    Subject.GROUPS: _groups,
    Subject.THREAD_COUNTS: _thread_counts,
    Subject.OWNERSHIPS: _ownerships,
}
