"""
What an executor holds, in a form in which live processes and specifications can be compared.

Leaves out names that the tool makes up and everything that rclpy creates by itself.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Callback, Spec


@dataclass(frozen=True, order=True)
class Member:
    """
    One entity somebody wrote.

    :param callback: last part of the function's qualified name; empty if there is none.
    :param key: topic, service or action without a leading slash, or seconds; empty if unknown.
    """

    node: str
    entity: str
    callback: str
    key: str


@dataclass(frozen=True, order=True)
class Group:
    """A callback group with at least one member; two groups are two values, even if equal."""

    type: str
    default: bool
    members: tuple[Member, ...]


@dataclass(frozen=True)
class Held:
    """An executor, its worker threads (1 for the spinning thread alone) and its groups."""

    kind: str
    threads: int
    groups: tuple[Group, ...]


def member(node: str, entity: str, callback: str | None, key: str | float | None) -> Member:
    text = f'{key:g} s' if isinstance(key, float) else (key or '').removeprefix('/')
    return Member(node, entity, callback or '', text)


def group(type_: str, *members: Member, default: bool = False) -> Group:
    return Group(type_, default, tuple(sorted(members)))


def held(kind: str, threads: int, *groups: Group) -> Held:
    return Held(kind, threads, tuple(sorted(groups)))


def of_probe(told: Mapping[str, Any]) -> Held:
    """Read one line of the probe."""
    grouped: dict[int, list[Mapping[str, Any]]] = defaultdict(list)
    for entity in told['entities']:
        grouped[entity['group']].append(entity)
    return held(
        told['kind'], told['threads'], *(_group_of_entities(each) for each in grouped.values())
    )


def of_spec(spec: Spec) -> Held:
    """Read a specification of any origin."""
    return held(
        str(spec.executor.kind),
        len(spec.executor.threads),
        *(
            Group(declared.type.value, declared.default, members)
            for declared in spec.groups
            if (members := _members(spec.callbacks, declared.name))
        ),
    )


def without_unknown_keys(observed: Held, expected: Held) -> Held:
    """Blank those keys of ``observed`` that ``expected`` could not find out."""
    unknown = {replace(each, key='') for each in _all_members(expected) if not each.key}
    return held(
        observed.kind,
        observed.threads,
        *(
            replace(each, members=tuple(sorted(_blank(one, unknown) for one in each.members)))
            for each in observed.groups
        ),
    )


def _all_members(whole: Held) -> Iterable[Member]:
    return (each for group_ in whole.groups for each in group_.members)


def _blank(one: Member, unknown: set[Member]) -> Member:
    blanked = replace(one, key='')
    return blanked if blanked in unknown else one


def _group_of_entities(entities: list[Mapping[str, Any]]) -> Group:
    members = (member(e['node'], e['entity'], e['callback'], e['key']) for e in entities)
    first = entities[0]
    return group(first['group_type'], *members, default=first['group_is_default'])


def _members(callbacks: Iterable[Callback], group_name: str) -> tuple[Member, ...]:
    return tuple(
        sorted(
            member(
                str(callback.node),
                callback.entity.value if callback.entity else callback.type.value,
                callback.function and callback.function.rpartition('.')[2],
                _known_key(callback),
            )
            for callback in callbacks
            if callback.group == group_name and not callback.builtin and not callback.groupless
        )
    )


def _known_key(callback: Callback) -> str | float | None:
    for key in (callback.key, callback.period_s):
        if key is not None and not isinstance(key, Unknown):
            return key
    return None
