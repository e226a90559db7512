"""
The only door from a specification to a model: every hole is closed by a policy, in words.

A model with a hole in it cannot be built by accident, because the generator takes a
``ClosedSpec`` and nothing else.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace

from ros2cc_extract.errors import IncompleteSpecError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.identifiers import mend
from ros2cc_extract.spec.model import (
    Activity,
    Callback,
    CallbackGroup,
    Executor,
    GroupType,
    Spec,
)


@dataclass(frozen=True, kw_only=True)
class Policy:
    """
    How holes are closed.

    :param builtin: keep rclpy's own entities in the model.
    :param threads: number of worker threads, instead of what the unit says.
    :param rclpy: version of rclpy, instead of the one that the unit names, if any.
    """

    builtin: bool = False
    threads: int | None = None
    rclpy: str | None = None


@dataclass(frozen=True, kw_only=True)
class ClosedSpec:
    """
    A unit without holes.

    :param spec: the unit, reduced to what the model shows; groups without members are left out.
    :param assumptions: what the policy decided, one clause each, for the reader of a verdict.
    :param arrivals: how often data arrives for a callback, where that is not as often as for all.
    """

    spec: Spec
    assumptions: tuple[str, ...]
    arrivals: Mapping[str, int] = field(default_factory=dict)


def waited_for(spec: Spec) -> frozenset[str]:
    """Names of those that end waits; what rclpy makes itself matters then."""
    doers: tuple[Callback | Activity, ...] = (*spec.callbacks, *spec.activities)
    blocks = (block for doer in doers for block in doer.blocking)
    return frozenset(waker.by for block in blocks for waker in block.wakers)


def close(spec: Spec, policy: Policy = Policy()) -> ClosedSpec:  # noqa: B008 - frozen value
    """
    Decide every open fact of ``spec`` by ``policy``.

    :raises IncompleteSpecError: when nothing is left to model.
    """
    waited = waited_for(spec)
    callbacks = tuple(
        c for c in spec.callbacks if policy.builtin or not c.builtin or c.name in waited
    )
    if not callbacks:
        raise IncompleteSpecError(
            f'unit {spec.name!r} has no callback', spec.executor.source, 'nothing to verify'
        )
    reduced = replace(
        spec,
        callbacks=callbacks,
        executor=_with_threads(spec, policy.threads),
        rclpy=policy.rclpy or spec.rclpy,
    )
    reduced = _with_tasks_in_no_group(reduced)
    used = {callback.group for callback in reduced.callbacks}
    reduced = replace(reduced, groups=tuple(g for g in reduced.groups if g.name in used))
    all_assumptions = (
        *_assumptions(reduced, policy),
        *_moved_tasks(reduced, spec),
        *_empty_groups(spec),
    )
    return ClosedSpec(spec=reduced, assumptions=all_assumptions)


def _empty_groups(spec: Spec) -> list[str]:
    """Say which groups have no member, not even one of rclpy's own."""
    used = {callback.group for callback in spec.callbacks}
    empty = (group.name for group in spec.groups if group.name not in used)
    return [f'group {name} has no callback, and is not modelled' for name in empty]


def _with_tasks_in_no_group(spec: Spec) -> Spec:
    """
    Take tasks out of exclusive groups, in which hand-written files may have put them.

    No executor asks a group for a task (rclpy 7.1.6 and 9.1.2, ``executors.py``, ``create_task``
    makes a ``Task`` without an entity), and an action server gives its execute callback and a
    future its done-callbacks to ``create_task``.
    """
    exclusive = {group.name for group in spec.groups if group.type is GroupType.EXCLUSIVE}
    misplaced = {c.name for c in spec.callbacks if _is_task(c) and c.group in exclusive}
    if not misplaced:
        return spec
    outside = next((group for group in spec.groups if group.groupless), None)
    groups = spec.groups
    if outside is None:
        name = mend('no_group', tuple(spec.names()))
        outside = CallbackGroup(name=name, type=GroupType.REENTRANT, groupless=True)
        groups = (*groups, outside)
    callbacks = tuple(
        replace(c, group=outside.name, groupless=True) if c.name in misplaced else c
        for c in spec.callbacks
    )
    return replace(spec, callbacks=callbacks, groups=groups)


def _is_task(callback: Callback) -> bool:
    return callback.entity is not None and callback.entity.is_task


def _moved_tasks(closed: Spec, spec: Spec) -> list[str]:
    """Say which tasks the unit as written has in a group."""
    written = {callback.name: callback.group for callback in spec.callbacks}
    return [
        f'{callback.name} is a task, which is in no group; not modelled in '
        f'{written[callback.name]}, where it was written'
        for callback in closed.callbacks
        if callback.group != written[callback.name]
    ]


def thread_names(spec: Spec, number: int) -> tuple[str, ...]:
    """Name ``number`` worker threads so that no other name of the unit is taken."""
    kept = spec.executor.threads[:number]
    taken = set(spec.names())
    names = list(kept)
    for index in range(len(kept), number):
        names.append(mend(f'thread_{index}', taken))
        taken.add(names[-1])
    return tuple(names)


def _with_threads(spec: Spec, number: int | None) -> Executor:
    if number is None or number == len(spec.executor.threads):
        return spec.executor
    return replace(
        spec.executor, threads=thread_names(spec, number), threads_source='given', assumed=None
    )


def _assumptions(spec: Spec, policy: Policy) -> list[str]:
    return [
        *_executor_assumptions(spec.executor, policy),
        *(text for group in spec.groups for text in _group_assumptions(group)),
        *(text for callback in spec.callbacks for text in _callback_assumptions(callback)),
    ]


def _executor_assumptions(executor: Executor, policy: Policy) -> list[str]:
    texts = []
    if isinstance(executor.kind, Unknown):
        texts.append(f'executor not found ({executor.kind}); modelled as one thread')
    elif executor.unresolved is not None:
        texts.append(f'executor {executor.kind} not resolved ({executor.unresolved})')
    if executor.threads_source == 'default_cpu_count' and policy.threads is None:
        texts.append(
            f'thread count is the number of CPUs at run time; {len(executor.threads)} assumed'
        )
    return texts


def _group_assumptions(group: CallbackGroup) -> list[str]:
    texts = []
    if group.unresolved is not None:
        texts.append(
            f'group {group.name} not resolved ({group.unresolved}); modelled as a group of its '
            f'own, {group.type.value}'
        )
    if group.assumed:
        texts.append(f'group {group.name}: {group.assumed}')
    return texts


def _callback_assumptions(callback: Callback) -> list[str]:
    texts = []
    if isinstance(callback.count, Unknown):
        texts.append(f'{callback.name} is created an unknown number of times; modelled once')
    elif callback.count > 1:
        texts.append(f'{callback.name} is created {callback.count} times; modelled once')
    if callback.conditional or callback.alternative:
        texts.append(f'{callback.name} is created under a condition; modelled as present')
    if callback.assumed:
        texts.append(f'{callback.name}: {callback.assumed}')
    return texts
