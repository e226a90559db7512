"""
Folds together what one line of the program makes again and again.

Memory is to depend on what the text of a program makes, not on how often it makes it. Only what
is gone is folded, and only what was not there at the same time: two nodes of one name side by
side stay two. Runs inside the user's process: the standard library only, nothing else of ours but
its neighbours.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from typing import Any, TypeVar

from .entries import EntityRecord, ExecutorRecord, GroupRecord, NodeRecord, TaskRecord

Gone = TypeVar('Gone', ExecutorRecord, NodeRecord)
Tasks = dict[tuple[Any, ...], TaskRecord]
# First begin and last end on the monotonic clock; ``None`` for what was never in service.
Span = tuple[int, int] | None


def fold_entities(entities: Iterable[EntityRecord]) -> list[EntityRecord]:
    """Give what is left; an entity says how often it was made."""
    gone: dict[tuple[Any, ...], EntityRecord] = {}
    kept = []
    for entity in entities:
        first = gone.setdefault(entity.signature(), entity) if entity.gone else entity
        if first is entity:
            kept.append(entity)
        else:
            first.made += entity.made
            first.timings.take_over(entity.timings)
    return kept


def fold_executors(
    executors: list[ExecutorRecord], nodes: list[NodeRecord], tasks: Tasks
) -> list[ExecutorRecord]:
    """Give what is left of the executors; nodes and tasks of the others belong to those."""
    spans: dict[int, Span] = defaultdict(lambda: None)
    for node in nodes:
        for stay in node.stays:
            number = stay.executor
            spans[number] = _hull(spans[number], stay.span(node.died))
    lost = set()
    for other, first in _pairs(executors, spans):
        lost.add(other.number)
        first.spun = first.spun or other.spun
        first.in_thread = other.in_thread if first.in_thread is None else first.in_thread
        for node in nodes:
            node.move(other, first.number)
        _move_tasks(tasks, other.number, first.number)
    return [each for each in executors if each.number not in lost]


def fold_nodes(
    nodes: list[NodeRecord],
    groups: list[GroupRecord],
    entities: list[EntityRecord],
    tasks: Tasks,
) -> tuple[list[NodeRecord], list[EntityRecord]]:
    """Give what is left of nodes and entities; what a node has made again counts once."""
    entities = _fold_with_their_groups(entities, groups)
    members: dict[int | None, list[EntityRecord]] = defaultdict(list)
    for entity in entities:
        members[entity.node].append(entity)
    whole = [node for node in nodes if all(each.gone for each in members[node.number])]
    spans: dict[int, Span] = {}
    for node in whole:
        spans[node.number] = None
        for stay in node.stays:
            spans[node.number] = _hull(spans[node.number], stay.span(node.died))
    lost_nodes, lost_entities = set(), set()
    for other, first in _pairs(whole, spans):
        lost_nodes.add(other.number)
        lost = _fold_members(other, first, groups, members)
        lost_entities |= lost
        first.swallow(other)
        for task in tasks.values():
            task.node = first.number if task.node == other.number else task.node
    return (
        [node for node in nodes if node.number not in lost_nodes],
        [entity for entity in entities if entity.number not in lost_entities],
    )


def _fold_with_their_groups(
    entities: list[EntityRecord], groups: list[GroupRecord]
) -> list[EntityRecord]:
    """
    Give what is left where each time a group was made too, for that entity alone.

    A coroutine that sleeps by way of a timer of its own does so. What was there at the same time
    stays apart: two groups are two, however alike.
    """
    users: dict[int, int] = defaultdict(int)
    for entity in entities:
        users[entity.group] += 1
    passing = {each.number: each.signature() for each in groups if each.ref() is None}
    lanes: dict[tuple[Any, ...], list[EntityRecord]] = defaultdict(list)
    kept = []
    for entity in entities:
        group = passing.get(entity.group) if users[entity.group] == 1 else None
        if entity.died is None or group is None:
            kept.append(entity)
            continue
        lane = lanes[group + entity.signature_in_any_group()]
        first = next((each for each in lane if _died(each) <= entity.born), None)
        if first is None:
            lane.append(entity)
            kept.append(entity)
        else:
            first.made += entity.made
            first.died = entity.died
            first.timings.take_over(entity.timings)
    return kept


def _died(entity: EntityRecord) -> int:
    assert entity.died is not None
    return entity.died


def _pairs(records: list[Gone], spans: dict[int, Span]) -> list[tuple[Gone, Gone]]:
    """Pair what is gone with the first of its kind, where the one was over before the other."""
    first_of: dict[tuple[Any, ...], Gone] = {}
    found = []
    for record in records:
        signature = record.signature()
        if signature is None or record.ref() is not None:
            continue
        first = first_of.setdefault(signature, record)
        if first is not record and not _overlap(spans[first.number], spans[record.number]):
            spans[first.number] = _hull(spans[first.number], spans[record.number])
            found.append((record, first))
    return found


def _overlap(one: Span, other: Span) -> bool:
    return one is not None and other is not None and one[0] < other[1] and other[0] < one[1]


def _hull(one: Span, other: Span) -> Span:
    if one is None or other is None:
        return one or other
    return min(one[0], other[0]), max(one[1], other[1])


def _move_tasks(tasks: Tasks, other: int, first: int) -> None:
    for key in [key for key in tasks if tasks[key].executor == other]:
        task = tasks.pop(key)
        task.executor = first
        known = tasks.setdefault((*key[:-1], first), task)
        if known is not task:
            known.count += task.count


def _fold_members(
    other: NodeRecord,
    first: NodeRecord,
    groups: list[GroupRecord],
    members: dict[int | None, list[EntityRecord]],
) -> set[int]:
    """Move the members of a node to the first; give the numbers of those it has already."""
    groups_of_first = _ordered_groups(members[first.number], groups)
    groups_of_other = _ordered_groups(members[other.number], groups)
    same = {
        number: groups_of_first.get(signature, number)
        for signature, number in groups_of_other.items()
    }
    known = {entity.signature(): entity for entity in members[first.number]}
    lost = set()
    for entity in members[other.number]:
        entity.node, entity.group = first.number, same[entity.group]
        made_first = known.get(entity.signature())
        if made_first is None:
            members[first.number].append(entity)
        else:
            made_first.made = max(made_first.made, entity.made)
            made_first.timings.take_over(entity.timings)
            lost.add(entity.number)
    for group in groups:
        group.node = first.number if group.node == other.number else group.node
    return lost


def _ordered_groups(
    members: list[EntityRecord], groups: list[GroupRecord]
) -> dict[tuple[Any, ...], int]:
    """Number the groups of a node by what they are and in which order a place makes them."""
    used = {entity.group for entity in members}
    found: dict[tuple[Any, ...], int] = {}
    for group in groups:
        if group.number in used:
            signature = group.signature()
            order = sum(known[:-1] == signature for known in found)
            distinct = (*signature, order)
            found[distinct] = group.number
    return found
