"""
The transitions of a life-cycle node as the one service that runs them.

A request of ``change_state`` says which of them it wants, and another one than the one that waits
may be wanted: its waits may be skipped. Source: rclpy 7.1.6, ``lifecycle/node.py``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ros2cc_extract.spec.model import Callback, EntityKind, Spec


def as_services(part: Spec) -> Spec:
    """A unit with the transitions of each node as one service, which waits as one of them does."""
    if not any(map(_is_transition, part.callbacks)):
        return part
    kept = {each.name: each for each in _served(part)}
    callbacks = [each for each in part.callbacks if not _is_transition(each) or each.name in kept]
    used = {each.group for each in callbacks}
    return replace(
        part,
        callbacks=tuple(kept.get(each.name, each) for each in callbacks),
        groups=tuple(each for each in part.groups if each.name in used),
    )


def several_wait(part: Spec) -> bool:
    """Whether several transitions of one node wait: which of them is asked for is not known."""
    nodes = [each.node for each in part.callbacks if _is_transition(each) and _waits(each)]
    return len(nodes) > len(set(nodes))


def _served(part: Spec) -> Iterator[Callback]:
    transitions = [each for each in part.callbacks if _is_transition(each)]
    for node in dict.fromkeys(each.node for each in transitions):
        mine = [each for each in transitions if each.node == node]
        one = next(filter(_waits, mine), mine[0])
        blocking = tuple(replace(block, conditional=True) for block in one.blocking)
        yield replace(one, entity=EntityKind.SERVICE, blocking=blocking)


def _is_transition(callback: Callback) -> bool:
    return callback.entity is EntityKind.LIFECYCLE_SERVICE and not callback.builtin


def _waits(callback: Callback) -> bool:
    return bool(callback.blocking or callback.locks)
