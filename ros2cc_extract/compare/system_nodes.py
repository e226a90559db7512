"""Which nodes of two systems are the same one, and which processes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeVar

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.identifiers import mend
from ros2cc_extract.spec.system.model import Process, System, SystemNode
from ros2cc_extract.spec.system.names import full_name

Item = TypeVar('Item')


@dataclass(frozen=True, eq=False)
class Placed:
    """A node with its process."""

    process: Process
    node: SystemNode


@dataclass(frozen=True)
class NodeMatching:
    """Which nodes are the same one."""

    pairs: tuple[tuple[Placed, Placed], ...]
    only_left: tuple[Placed, ...]
    only_right: tuple[Placed, ...]


def match_nodes(left: System, right: System) -> NodeMatching:
    """
    Pair nodes by ever weaker identities: full name, own name, what they have.

    A name that the launch file gives to a process whose code is not available counts.
    """
    identities = (_full_name, _own_name, _last_name, _ends)
    pairs, rest_left, rest_right = paired(placed(left), placed(right), identities)
    order = {id(each.node): number for number, each in enumerate(placed(left))}
    pairs.sort(key=lambda pair: order.get(id(pair[0].node), 0))
    return NodeMatching(tuple(pairs), tuple(rest_left), tuple(rest_right))


def paired(
    left: Iterable[Item], right: Iterable[Item], identities: Sequence[Callable[[Item], object]]
) -> tuple[list[tuple[Item, Item]], list[Item], list[Item]]:
    """
    Pair what is alike by ever weaker identities, and give the rest of each side.

    By any but the first, only what nothing else of either side is alike with.
    """
    rest_left, rest_right = list(left), list(right)
    pairs: list[tuple[Item, Item]] = []
    for number, identity in enumerate(identities):
        for mine in list(rest_left):
            sought = identity(mine)
            fitting = [each for each in rest_right if identity(each) == sought]
            others = [each for each in rest_left if identity(each) == sought]
            is_sure = number == 0 or len(fitting) == len(others) == 1
            if sought is not None and fitting and is_sure:
                pairs.append((mine, fitting[0]))
                rest_left.remove(mine)
                rest_right.remove(fitting[0])
    return pairs, rest_left, rest_right


def placed(system: System) -> Iterator[Placed]:
    """Every node; of a process whose code is not available, the one that the launch file names."""
    for process in system.processes:
        if process.nodes:
            yield from (Placed(process, node) for node in process.nodes)
        elif process.outside is not None and isinstance(process.launched.name, str):
            yield Placed(process, _expected(process))


def _expected(process: Process) -> SystemNode:
    launched = process.launched
    space = launched.namespace or '/'
    name = launched.name
    assert isinstance(name, str)
    return SystemNode(
        name=space if isinstance(space, Unknown) else full_name(space, name),
        own_name=name,
        open=process.outside,
        source=launched.source,
    )


def _full_name(each: Placed) -> object:
    return each.node.name if isinstance(each.node.name, str) else None


def _own_name(each: Placed) -> object:
    own = each.node.own_name
    return mend(own) if isinstance(own, str) and isinstance(each.node.name, Unknown) else None


def _last_name(each: Placed) -> object:
    """In another namespace."""
    name = each.node.name if isinstance(each.node.name, str) else each.node.own_name
    return mend(name.rpartition('/')[2]) if isinstance(name, str) else None


def _ends(each: Placed) -> object:
    """Of another name, with the same topics, services and actions."""
    ends = frozenset(
        (end.kind, end.name.rpartition('/')[2], end.type)
        for end in each.node.endpoints
        if isinstance(end.name, str)
    )
    return ends or None
