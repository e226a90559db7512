"""Joins two systems, as of a launch file and of what ran: the facts of the first count."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ros2cc_extract.compare.merge import match_units, merge_units
from ros2cc_extract.compare.system_nodes import match_nodes
from ros2cc_extract.compare.systems import match_endpoints
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.system.model import Process, System, SystemEndpoint, SystemNode


def merge_systems(left: System, right: System) -> System:
    """
    Add to ``left`` what it does not know.

    Processes whose nodes are the same are one; others of ``right`` are added, with names of
    their own.
    """
    matching = match_nodes(left, right)
    partner: dict[int, Process] = {}
    nodes: dict[int, tuple[SystemNode, SystemNode]] = {}
    for mine, theirs in matching.pairs:
        partner.setdefault(id(mine.process), theirs.process)
        nodes[id(theirs.node)] = mine.node, theirs.node
    merged = [
        _joined(process, partner[id(process)], nodes) if id(process) in partner else process
        for process in left.processes
    ]
    used = {id(process) for process in partner.values()}
    taken = {process.name for process in merged}
    for process in right.processes:
        if id(process) not in used:
            name = _free(process.name, taken)
            taken.add(name)
            merged.append(replace(process, name=name))
    return System(
        name=left.name,
        processes=tuple(merged),
        sources=tuple(dict.fromkeys((*left.sources, *right.sources))),
        unresolved=tuple(dict.fromkeys((*left.unresolved, *right.unresolved))),
    )


def _joined(
    mine: Process, theirs: Process, nodes: dict[int, tuple[SystemNode, SystemNode]]
) -> Process:
    """One process of two; what was outside is known by what was seen of it."""
    joined = {id(one): _node(one, other) for one, other in nodes.values()}
    kept = [joined.get(id(node), node) for node in mine.nodes]
    kept += [node for node in theirs.nodes if id(node) not in nodes or not mine.nodes]
    return replace(
        mine,
        outside=mine.outside if not theirs.units else None,
        nodes=tuple(kept),
        units=_units(mine.units, theirs.units),
    )


def _units(mine: Sequence[Spec], theirs: Sequence[Spec]) -> tuple[Spec, ...]:
    pairs, only_mine, only_theirs = match_units(mine, theirs)
    merged = [merge_units(*pair) for pair in pairs]
    return (*merged, *only_mine, *only_theirs)


def _node(mine: SystemNode, theirs: SystemNode) -> SystemNode:
    pairs, _, only_theirs = match_endpoints(mine, theirs)
    ends = {id(one): _end(one, other) for one, other in pairs}
    return replace(
        mine,
        name=theirs.name if isinstance(mine.name, Unknown) else mine.name,
        endpoints=(
            *(ends.get(id(end), end) for end in mine.endpoints),
            *only_theirs,
        ),
    )


def _end(mine: SystemEndpoint, theirs: SystemEndpoint) -> SystemEndpoint:
    return replace(
        mine,
        name=theirs.name if isinstance(mine.name, Unknown) else mine.name,
        type=mine.type or theirs.type,
        of=replace(mine.of, type=mine.of.type or theirs.of.type, qos=mine.of.qos or theirs.of.qos),
    )


def _free(name: str, taken: set[str]) -> str:
    number, candidate = 2, name
    while candidate in taken:
        candidate, number = f'{name}_{number}', number + 1
    return candidate
