"""
What the model of a part of a unit depends on: its shape, without names.

Parts of one shape have one model up to names, and so the same verdicts.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.generator.executor_kinds import (
    GUARD_RANK,
    NODE_RANK,
    TIMER_RANK,
    executor_kind,
    rank_of,
    task_order,
)
from ros2cc_extract.generator.omissions import left_out_of_models
from ros2cc_extract.generator.program_steps import NamedWait, Resource
from ros2cc_extract.generator.unit import resources_of
from ros2cc_extract.generator.waits import foreign_wakes, waits_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.client_server_pairs import server_of
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import Callback, CallbackType, GroupType, Spec

Shape = tuple[object, ...]


@dataclass(frozen=True)
class Facts:
    """
    What the model of a part shows of a callback.

    :param place: among all callbacks, in the order of their making.
    :param server: name of the service that answers it, for a client.
    :param is_open: it is asked for its end since something of it is in no model.
    :param arrivals: how often data arrives for it; 0 for as often as for all.
    """

    name: str
    place: int
    rank: int
    node: object
    group: str
    group_type: GroupType
    is_client: bool
    is_groupless: bool
    is_one_shot: bool
    waits: tuple[NamedWait, ...] = ()
    server: str | None = None
    is_open: bool = False
    arrivals: int = 0


@dataclass(frozen=True)
class Setting:
    """What all callbacks of a part share; ``threads`` are no more than can be at work in it."""

    executor: object
    threads: int
    rclpy: Shape
    max_cycle: int | None


@dataclass(frozen=True)
class Outline:
    """A part without its names, and its names in the order in which the shape numbers them."""

    shape: Shape
    callbacks: tuple[str, ...]
    groups: tuple[str, ...]


def facts_of(callback: Callback, place: int, part: Spec, arrivals: int = 0) -> Facts:
    """Collect what the model of ``part`` shows of one of its callbacks."""
    server = server_of(callback, part.callbacks)
    return Facts(
        callback.name,
        place,
        rank_of(callback),
        callback.node,
        callback.group,
        part.group_of(callback).type,
        callback.type is CallbackType.CLT,
        callback.groupless,
        callback.one_shot,
        tuple(waits_of(callback, part)),
        None if server is None else server.name,
        bool(left_out_of_models(callback, part)),
        arrivals,
    )


def setting_of(part: Spec, max_cycle: int | None) -> Setting:
    """Collect what all callbacks share; of a release only what it does otherwise."""
    release = (task_order(part.rclpy), foreign_wakes(part))
    return Setting(executor_kind(part), len(part.executor.threads), release, max_cycle)


def outline_of(closed: ClosedSpec, max_cycle: int | None) -> Outline:
    """Give the outline of a part as it is written."""
    part, arrivals = closed.spec, closed.arrivals
    facts = [
        facts_of(callback, place, part, arrivals.get(callback.name, 0))
        for place, callback in enumerate(part.callbacks)
    ]
    return outline(facts, setting_of(part, max_cycle))


def outline(facts: Iterable[Facts], setting: Setting) -> Outline:
    """
    Number callbacks in serving order, nodes, groups and locks as they come.

    Then of ranks nothing else counts but for tasks, waitables and guard conditions, which the
    executors treat apart. Of clients of one service the first is answered first: with a service,
    or signals, they are numbered as they were made, and ranks are part of the shape.
    """
    facts = sorted(facts, key=lambda each: each.place)
    waiting = any(each.waits for each in facts)
    resources = resources_of({each.name: each.waits for each in facts})
    keeps_order = waiting and (bool(resources) or any(each.server for each in facts))
    if not keeps_order:
        facts.sort(key=lambda each: each.rank)  # stable: within a rank as they were made
    places = {each.name: place for place, each in enumerate(facts)}
    nodes = {node: n for n, node in enumerate(dict.fromkeys(each.node for each in facts))}
    groups = {name: n for n, name in enumerate(dict.fromkeys(each.group for each in facts))}
    locks = dict.fromkeys(w.lock for each in facts for w in each.waits if w.lock)
    numbers = _Numbers(places, nodes, {lock: n for n, lock in enumerate(locks)}, resources)
    ranks = sorted({each.rank for each in facts if each.rank >= NODE_RANK})
    is_timed = waiting or (setting.max_cycle or 1) > 1
    types = {each.group: each.group_type for each in facts}
    shape = (
        setting.executor,
        setting.threads,
        setting.rclpy,
        setting.max_cycle,
        tuple(types[name] for name in groups),
        tuple(
            (
                min(each.rank, NODE_RANK),
                each.rank == GUARD_RANK,
                is_timed and each.rank == TIMER_RANK,
                keeps_order and each.rank >= NODE_RANK and ranks.index(each.rank),
                waiting and each.is_client,
                nodes[each.node],
                groups[each.group],
                each.is_groupless,
                each.is_one_shot,
                tuple(numbers.of(wait) for wait in each.waits),
                places.get(each.server or '') if waiting else None,
                each.is_open,
                each.arrivals,
            )
            for each in facts
        ),
    )
    return Outline(shape, tuple(places), tuple(groups))


@dataclass(frozen=True)
class _Numbers:
    places: Mapping[str, int]
    nodes: Mapping[object, int]
    locks: Mapping[object, int]
    resources: Sequence[Resource]

    def of(self, wait: NamedWait) -> Shape:
        return (
            self.places.get(wait.needed),
            wait.kind,
            self._spin(wait),
            None if wait.lock is None else self.locks[wait.lock],
            self._held(wait),
            self._signalled(wait),
        )

    def _spin(self, wait: NamedWait) -> Shape | None:
        if wait.spin is None:
            return None
        node = None if wait.spin.node is None else self.nodes.get(wait.spin.node)
        return replace(wait.spin, node=None, needed=None), node

    def _signalled(self, step: NamedWait) -> Shape:
        in_doubt = step.is_open or (step.is_signal and step.may_skip)
        words = (step.origin, step.block, step.waker) if in_doubt else None  # of the reason
        if step.resource is None:
            return step.may_skip, words
        place, resource = self.resources.index(step.resource), step.resource
        kind = resource.is_each, resource.initial, resource.forgets, resource.least
        return place, kind, step.may_skip, step.past, words

    def _held(self, wait: NamedWait) -> Sequence[int]:
        return tuple(sorted(self.locks[lock] for lock in wait.held))
