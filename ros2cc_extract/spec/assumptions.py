"""
Close holes of a unit by what the user vouches for: ``--assume threads=4``.

An assumption fills only what is unknown or a default; what the source says stays. Every fact
filled that way carries the assumption, so that no verdict hides it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import field, replace

from ros2cc_extract.errors import InputError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.close import thread_names
from ros2cc_extract.spec.model import (
    CallbackGroup,
    Executor,
    GroupType,
    Spec,
    collect_unresolved,
)
from ros2cc_extract.spec.releases.lines import BY_DISTRO

DEFAULT_COUNT = 'default_cpu_count'
MEND = 'write threads=N, executor=CLASS, rclpy=X.Y.Z|DISTRO or group.NAME=EXCLUSIVE|REENTRANT'
_RELEASE = re.compile(r'\d+\.\d+\.\d+')
_GROUP = 'group.'


@dataclass(frozen=True, kw_only=True)
class Assumptions:
    """
    What to take for granted where the source does not say it.

    :param threads: worker threads of executors whose number is not known.
    :param executor: class of executors that were not found.
    :param groups: type by name of unresolved groups.
    :param rclpy: release that facts are tied to which name none.
    """

    threads: int | None = None
    executor: str | None = None
    rclpy: str | None = None
    groups: Mapping[str, GroupType] = field(default_factory=dict)


def read_assumptions(entries: Iterable[str], place: Place | None = None) -> Assumptions:
    """
    Read ``threads=4`` and the like; a later entry wins.

    :raises InputError: for an entry of another form.
    """
    threads: int | None = None
    executor: str | None = None
    rclpy: str | None = None
    groups: dict[str, GroupType] = {}
    for entry in entries:
        key, equals, value = entry.partition('=')
        if key == 'threads' and value.isascii() and value.isdigit() and int(value) > 0:
            threads = int(value)
        elif key == 'executor' and value.isidentifier():
            executor = value
        elif key == 'rclpy' and (_RELEASE.fullmatch(value) or value in BY_DISTRO):
            rclpy = value
        elif key.startswith(_GROUP) and equals and value in GroupType.__members__:
            groups[key.removeprefix(_GROUP)] = GroupType[value]
        else:
            raise InputError(f'assumption {entry!r} is not understood', place, MEND)
    return Assumptions(threads=threads, executor=executor, rclpy=rclpy, groups=groups)


def assume(spec: Spec, assumptions: Assumptions) -> Spec:
    """Fill the holes of ``spec`` that ``assumptions`` speak of."""
    executor = _with_threads(_with_kind(spec.executor, assumptions), spec, assumptions)
    groups = tuple(_with_type(group, assumptions) for group in spec.groups)
    if spec.rclpy is None:
        spec = replace(spec, rclpy=assumptions.rclpy)
    if executor == spec.executor and groups == spec.groups:
        return spec
    filled = replace(spec, executor=executor, groups=groups)
    before, after = set(collect_unresolved(spec)), set(collect_unresolved(filled))
    closed = before - after
    return replace(filled, unresolved=tuple(f for f in spec.unresolved if f not in closed))


def _with_kind(executor: Executor, assumptions: Assumptions) -> Executor:
    if assumptions.executor is None or not isinstance(executor.kind, Unknown):
        return executor
    return replace(
        executor, kind=assumptions.executor, assumed=f'executor={assumptions.executor} (--assume)'
    )


def _with_threads(executor: Executor, spec: Spec, assumptions: Assumptions) -> Executor:
    number = assumptions.threads
    is_open = (
        executor.unresolved is not None
        or executor.threads_source == DEFAULT_COUNT
        or isinstance(spec.executor.kind, Unknown)
    )
    if number is None or not is_open:
        return executor
    return replace(
        executor,
        threads=thread_names(spec, number),
        threads_source='assumed',
        unresolved=None,
        assumed=f'threads={number} (--assume)',
    )


def _with_type(group: CallbackGroup, assumptions: Assumptions) -> CallbackGroup:
    kind = assumptions.groups.get(group.name)
    if kind is None or group.unresolved is None:
        return group
    return replace(
        group, type=kind, unresolved=None, assumed=f'group.{group.name}={kind.value} (--assume)'
    )
