"""
From a closed specification to a complete UPPAAL model and its queries.

Owns the text of the models; the templates under ``profiles/`` are the only description of the
executor's semantics. Knows nothing of how a model is explored.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from types import MappingProxyType
from typing import TYPE_CHECKING

from ros2cc_extract.generator.executor_kinds import (
    GUARD_RANK,
    QUEUED_TWICE,
    TASK_RANK,
    ExecutorKind,
    task_order,
)
from ros2cc_extract.generator.queries import (
    IN_DOUBT,
    Family,
    Query,
    paper_queries,
    rclpy_queries,
    with_doubts,
    write_query_file,
)
from ros2cc_extract.generator.template_files import PUBLISHED, Profile, Text, choose_sources
from ros2cc_extract.generator.unit import Unit, number_unit
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import ClosedSpec

if TYPE_CHECKING:
    from jinja2 import Environment

__all__ = [
    'IN_DOUBT',
    'Family',
    'Freedom',
    'ModelAlone',
    'Profile',
    'Query',
    'RenderedModel',
    'Text',
    'render',
    'render_alone',
]

#: What compact texts let move; docs/model.md shows that more would change no verdict.
CALLBACKS_IN_PLAY = 2
THREADS_IN_PLAY = 2
#: Unlimited arrivals: the member of a group served first starves by two others, not by one.
CALLBACKS_IN_PLAY_FOR_EVER = 3


@dataclass(frozen=True, kw_only=True)
class Freedom:
    """
    How much of what rclpy does a model of profile rclpy shows; the least is enough for verdicts.

    :param queued: how many runs of one guard condition or task may be queued at a time.
    :param suspended: how many runs of one callback may be suspended at a time.
    :param made: how many runs of one task may be made at a time and not have begun; ``None`` for
        all that arrive.
    :param nested: how many callbacks may spin on one thread at a time, one inside the other;
        ``None`` for all that there can be.
    :param observed: for comparison with executions. Answers of a service to other clients wake
        its other clients too (Fast DDS); an awaited callback has to end once more, not once; a
        guard condition that was triggered in a closed group is looked at whenever the executor
        is woken; two workers may change places between the queue and the group; groups open
        and close while the executor looks at its entities, one after the other.
    """

    queued: int = 1
    suspended: int = 1
    made: int | None = None
    nested: int | None = None
    observed: bool = False


@dataclass(frozen=True, kw_only=True)
class ModelAlone:
    """
    A model to be asked, and what to ask.

    :param xml: the model without its queries, which a large unit has by the hundred thousand.
    """

    name: str
    xml: str
    queries: tuple[Query, ...]


@dataclass(frozen=True, kw_only=True)
class RenderedModel:
    """
    A model ready to be written.

    :param name: name of the unit.
    :param xml: the complete model, as UPPAAL opens it, queries included.
    :param queries: in the order of ``q`` and of the queries of ``xml``.
    :param published: the files of the published tool by file name, to be pasted into the
        published template, which has a bound on arrivals: none of them where there is no bound.
    """

    name: str
    xml: str
    queries: tuple[Query, ...]
    q: str
    published: Mapping[str, str]


def render(
    closed: ClosedSpec,
    *,
    profile: Profile = Profile.PAPER,
    text: Text = Text.PLAIN,
    max_cycle: int | None = 1,
    freedom: Freedom | None = None,
) -> RenderedModel:
    """
    Write the model of ``closed``.

    :param max_cycle: how often each callback may become ready, at least 1; ``None`` for no bound.
    :param freedom: of profile rclpy; what verdicts need where it is left out.
    :raises ValueError: when ``max_cycle`` is below 1.
    """
    whole = _numbered(closed, max_cycle)
    numbered = _shown(whole, Profile.PAPER)
    published = paper_queries(numbered)
    unit = _shown(whole, profile)
    queries = rclpy_queries(unit) if profile is Profile.RCLPY else published
    features = _features(unit, freedom or _least_freedom(unit), closed.spec.rclpy)
    return RenderedModel(
        name=unit.name,
        xml=_write_xml(unit, queries, profile, text, features),
        queries=queries,
        q=write_query_file(queries),
        published=_write_published_files(numbered, published),
    )


def render_alone(
    closed: ClosedSpec,
    *,
    profile: Profile = Profile.PAPER,
    text: Text = Text.PLAIN,
    max_cycle: int | None = 1,
    watched: str | None = None,
) -> ModelAlone:
    """
    Write the model of ``closed`` for a caller that asks the queries separately.

    :param max_cycle: as for ``render``.
    :param watched: a formula over the global variables of the plain text. The model then has a
        process ``watcher`` more, which may be in ``seen`` from a state on in which it holds.
    :raises ValueError: when ``max_cycle`` is below 1.
    """
    unit = _shown(_numbered(closed, max_cycle), profile)
    features = _features(unit, _least_freedom(unit), closed.spec.rclpy)
    return ModelAlone(
        name=unit.name,
        xml=_write_xml(unit, (), profile, text, features, watched),
        queries=_queries_of(unit, profile),
    )


def _numbered(closed: ClosedSpec, max_cycle: int | None) -> Unit:
    if max_cycle is not None and max_cycle < 1:
        raise ValueError(f'max_cycle must be at least 1, not {max_cycle}')
    return number_unit(closed, max_cycle)


def _shown(whole: Unit, profile: Profile) -> Unit:
    """What a profile shows of a unit; the published model has no activities."""
    is_rclpy = profile is Profile.RCLPY
    return _with_threads_that_run(whole) if is_rclpy else replace(whole, activities=())


def _queries_of(unit: Unit, profile: Profile) -> tuple[Query, ...]:
    return rclpy_queries(unit) if profile is Profile.RCLPY else paper_queries(unit)


def _least_freedom(unit: Unit) -> Freedom:
    """Where several runs of a callback matter, one begins while another is suspended."""
    several = unit.has_arrivals_of_their_own or unit.has_concurrent_awaits
    return Freedom(suspended=2 if several else 1)


def queries_of(
    closed: ClosedSpec, *, profile: Profile = Profile.PAPER, max_cycle: int | None = 1
) -> tuple[Query, ...]:
    """List the queries of ``closed``, without its model."""
    return _queries_of(_shown(number_unit(closed, max_cycle), profile), profile)


def _with_threads_that_run(unit: Unit) -> Unit:
    """Only a pool has as many threads as one asks for."""
    has_pool = unit.kind is ExecutorKind.MULTI_THREADED
    return unit if has_pool else replace(unit, threads=unit.threads[:1])


def _write_xml(
    unit: Unit,
    queries: tuple[Query, ...],
    profile: Profile,
    text: Text,
    features: Mapping[str, object],
    watched: str | None = None,
) -> str:
    sources = choose_sources(profile, text, unit)
    in_play = CALLBACKS_IN_PLAY if unit.max_cycle else CALLBACKS_IN_PLAY_FOR_EVER
    if unit.has_spins or unit.has_foreign or unit.has_absent:
        in_play = len(unit.callbacks)  # all that a nested spin serves may matter
    values = {
        'unit': unit,
        **features,
        'callbacks_in_play': in_play if text is Text.COMPACT else None,
        'threads_in_play': THREADS_IN_PLAY,
        'watched': watched,
    }
    return _fill(
        'shared/model.xml.j2',
        **values,
        queries=tuple(with_doubts(queries)),
        automata=(*sources.automata, *(['shared/watcher.xml.j2'] if watched else ())),
        declarations=_fill(sources.declarations, **values),
        system=_fill(sources.system, **values),
    )


def _features(unit: Unit, freedom: Freedom, rclpy: str | None) -> Mapping[str, object]:
    """What of the executor's text a unit needs; the rest would only make more states."""
    ranks = [callback.rank for callback in unit.callbacks]
    tasks = ranks.count(TASK_RANK)
    has_executor_laps = unit.kind.has_laps
    has_pool = unit.kind is ExecutorKind.MULTI_THREADED
    has_guards = GUARD_RANK in ranks
    pool_spins = has_pool and unit.has_own_spins
    signals = freedom.observed and unit.has_awaits
    needs_laps = unit.has_foreign and not unit.foreign_wakes
    has_servers = any(callback.server is not None for callback in unit.callbacks)
    return {
        'has_tasks': unit.has_awaits or tasks > 0,
        'tasks': tasks,
        'task_awaits': unit.kind is ExecutorKind.SINGLE_THREADED
        and any(
            wait.frees_thread
            for callback in unit.callbacks
            if callback.rank == TASK_RANK
            for wait in callback.waits
        ),
        'task_order': task_order(rclpy) if tasks > 1 and has_executor_laps else None,
        'has_guards': has_guards,
        'answers_early': has_pool and bool(unit.num_waits) and (has_servers or signals),
        'observed': freedom.observed,
        'has_pool': has_pool,
        'asks_groups': has_executor_laps,
        'num_actors': 'NUM_ACTOR' if unit.activities else 'NUM_CB',
        'is_activity': False,
        # On a pool the spinning thread only hands over, and the workers run what is there.
        'nests_on_threads': unit.has_global_spins or (unit.has_own_spins and not has_pool),
        'nested_runs': min(unit.nested_runs, freedom.nested or unit.nested_runs),
        'drops_harvest': unit.has_own_spins and not has_pool,
        'pool_spins': pool_spins,
        'gathers': freedom.observed and has_pool,
        # A worker may go on with a coroutine unasked; what is asked would only make more states.
        'polls': unit.has_awaits and has_pool and (needs_laps or not freedom.observed),
        'foreign_answers': freedom.observed and bool(unit.called),
        'signals': signals,
        'queued_again': len(ranks) if pool_spins else ranks.count(GUARD_RANK) + tasks,
        'queued_runs': max(freedom.queued, QUEUED_TWICE)
        if has_guards or pool_spins
        else freedom.queued,
        'suspended_runs': freedom.suspended,
        'made_runs': freedom.made,
    }


def _write_published_files(unit: Unit, queries: tuple[Query, ...]) -> Mapping[str, str]:
    if unit.max_cycle is None:
        return MappingProxyType({})
    return MappingProxyType(
        {
            f'{unit.name}_declarations.c': _fill(PUBLISHED.declarations, unit=unit),
            f'{unit.name}_system.c': _fill(PUBLISHED.system, unit=unit),
            f'{unit.name}_query.q': write_query_file(queries),
        }
    )


def _fill(template: str, **values: object) -> str:
    return _environment().get_template(template).render(values)


@cache
def _environment() -> Environment:
    # Imported late: reading kept verdicts starts faster without it.
    from ros2cc_extract.generator.templates import environment

    return environment()
