"""
Where the parts of a system stand in a picture: processes on both sides, connections between.

Senders and clients are on the left as far as possible, so that most arrows go to the
right. Boxes of a side are ordered by what they are connected with, over and over, as in the
layered drawings of Sugiyama et al.; the order is the same for the same system.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Mapping, Sequence
from typing import TypeVar

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.node_graph import EndpointKind
from ros2cc_extract.spec.system.model import Connection, Process, System

FROM = (EndpointKind.PUBLISHER, EndpointKind.CLIENT, EndpointKind.ACTION_CLIENT)
"""Kinds of senders and clients."""
ROUNDS = 4
Item = TypeVar('Item', bound=Hashable)


@dataclass(frozen=True)
class Columns:
    """
    The order from top to bottom.

    :ivar left: names of processes, as ``right``.
    """

    left: tuple[str, ...]
    right: tuple[str, ...]
    connections: tuple[Connection, ...]


def columns_of(system: System) -> Columns:
    """Order all processes and connections."""
    touched = _touched(system)
    left, right = _sides(system)
    numbers = list(range(len(system.connections)))
    for _ in range(ROUNDS):
        at = _positions([*left]) | _positions([*right])
        numbers = _by_mean(numbers, {n: [at[name] for name in touched[n]] for n in numbers})
        near = _near(touched, _positions(numbers))
        left, right = _by_mean(left, near), _by_mean(right, near)
    return Columns(
        tuple(left), tuple(right), tuple(system.connections[number] for number in numbers)
    )


def _touched(system: System) -> list[list[str]]:
    """The processes at each connection."""
    return [
        list(dict.fromkeys(end.process.name for end in each.ends)) for each in system.connections
    ]


def _near(touched: Sequence[Sequence[str]], at: Mapping[int, float]) -> dict[str, list[float]]:
    found: dict[str, list[float]] = defaultdict(list)
    for number, names in enumerate(touched):
        for name in names:
            found[name].append(at[number])
    return found


def _sides(system: System) -> tuple[list[str], list[str]]:
    """Half of the processes on each side, those that rather send on the left."""
    surplus: dict[str, int] = defaultdict(int)
    for end in system.ends:
        surplus[end.process.name] += 1 if end.endpoint.kind in FROM else -1
    order = {process.name: number for number, process in enumerate(system.processes)}
    ranked = sorted(order, key=lambda name: (-surplus[name], order[name]))
    half = (_height(system.processes) + 1) // 2
    left: list[str] = []
    filled = 0
    sizes = {process.name: rows_of(process) for process in system.processes}
    for name in ranked:
        if filled < half:
            left.append(name)
            filled += sizes[name]
    return left, [name for name in ranked if name not in left]


def rows_of(process: Process) -> int:
    """How many rows a process takes: its name, its nodes, its executors."""
    return 2 + len(process.nodes) + len(process.units)


def _height(processes: Sequence[Process]) -> int:
    return sum(map(rows_of, processes))


def _positions(items: Sequence[Item]) -> dict[Item, float]:
    """Where each stands, from 0 at the top to 1."""
    return {item: (number + 0.5) / len(items) for number, item in enumerate(items)}


def _by_mean(items: Sequence[Item], places: Mapping[Item, Sequence[float]]) -> list[Item]:
    """In the order of the means of the places of what they are connected with."""
    own = _positions(items)
    means = {item: sum(at) / len(at) for item in items if (at := places.get(item, ()))}
    return sorted(items, key=lambda item: means.get(item, own[item]))
