"""
Compares two systems: what a launch file starts with what ran, or with another one.

What is known on one side alone proves nothing where the other side has not seen everything: such
a difference is marked, as in ``merge.py``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ros2cc_extract.compare.merge import NOT_KNOWN, Difference, Kind
from ros2cc_extract.compare.system_nodes import NodeMatching, Placed, match_nodes, paired
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.node_graph import Qos
from ros2cc_extract.spec.system.launched import RECORDED
from ros2cc_extract.spec.system.model import Process, System, SystemEndpoint, SystemNode

Pair = tuple[SystemEndpoint, SystemEndpoint]
_POLICIES = ('reliability', 'durability', 'deadline_s', 'liveliness', 'lease_s')


def diff_systems(left: System, right: System) -> tuple[Difference, ...]:
    """List what differs, node by node in the order of ``left``."""
    matching = match_nodes(left, right)
    found = [each for pair in matching.pairs for each in _of_nodes(*pair)]
    found += [_missing_node(each, Kind.ONLY_LEFT, right) for each in matching.only_left]
    found += [_missing_node(each, Kind.ONLY_RIGHT, left) for each in matching.only_right]
    found += [_nameless(each, right) for each in _unseen(left, matching)]
    return tuple(found)


def _of_nodes(mine: Placed, theirs: Placed) -> Iterator[Difference]:
    name = shown(mine.node)
    if mine.node.name != theirs.node.name:
        yield _differs(name, name, 'name', mine.node, theirs.node)
    pairs, only_left, only_right = match_endpoints(mine.node, theirs.node)
    for one, other in pairs:
        yield from _of_endpoints(name, one, other)
    for end in only_left:
        yield _missing_end(name, end, Kind.ONLY_LEFT, theirs.node)
    for end in only_right:
        yield _missing_end(name, end, Kind.ONLY_RIGHT, mine.node)


def match_endpoints(
    left: SystemNode, right: SystemNode
) -> tuple[list[Pair], list[SystemEndpoint], list[SystemEndpoint]]:
    """
    Pair the endpoints of one node, and give those of one side alone.

    By ever weaker identities: name, what the code writes, the place of creation, the last part of
    the name, the type where there is one of it.
    """
    identities = (_by_name, _by_words, _by_place, _by_last_part, _by_type)
    return paired(left.endpoints, right.endpoints, identities)


def _by_name(end: SystemEndpoint) -> object:
    return (end.kind, end.name) if isinstance(end.name, str) else None


def _by_words(end: SystemEndpoint) -> object:
    return (end.kind, end.written) if isinstance(end.written, str) else None


def _by_place(end: SystemEndpoint) -> object:
    place = end.source
    return (end.kind, place.file.rpartition('/')[2], place.line) if place else None


def _by_last_part(end: SystemEndpoint) -> object:
    return (end.kind, end.name.rpartition('/')[2]) if isinstance(end.name, str) else None


def _by_type(end: SystemEndpoint) -> object:
    return (end.kind, end.type) if end.type else None


def _of_endpoints(node: str, mine: SystemEndpoint, theirs: SystemEndpoint) -> Iterator[Difference]:
    subject = shown_end(mine if isinstance(mine.name, str) else theirs)
    if mine.name != theirs.name:
        yield _differs(node, subject, 'name', mine, theirs)
    if mine.type and theirs.type and mine.type != theirs.type:
        found = _differs(node, subject, 'type', mine, theirs)
        yield replace(found, left=mine.type, right=theirs.type, kind=Kind.DIFFERS, marked=False)
    for policy, one, other in _policies(mine.of.qos, theirs.of.qos):
        found = _differs(node, subject, policy, mine, theirs)
        yield replace(found, left=one, right=other, kind=Kind.DIFFERS, marked=False)


def _policies(mine: Qos | None, theirs: Qos | None) -> Iterator[tuple[str, str, str]]:
    """The policies that both sides know and that differ."""
    if mine is None or theirs is None:
        return
    for name in _POLICIES:
        one, other = getattr(mine, name), getattr(theirs, name)
        is_time = name.endswith('_s')
        is_known = not isinstance(one, Unknown) and not isinstance(other, Unknown)
        if is_known and one != other and (is_time or None not in (one, other)):
            yield name, _policy(one), _policy(other)


def _policy(value: str | float | None) -> str:
    return 'none' if value is None else value if isinstance(value, str) else f'{value:g} s'


def _differs(
    node: str,
    subject: str,
    fact: str,
    mine: SystemNode | SystemEndpoint,
    theirs: SystemNode | SystemEndpoint,
) -> Difference:
    is_open = isinstance(mine.name, Unknown) or isinstance(theirs.name, Unknown)
    return Difference(
        kind=Kind.NOT_KNOWN if is_open else Kind.DIFFERS,
        unit=node,
        subject=subject,
        fact=fact,
        left=_shown(mine.name),
        right=_shown(theirs.name),
        left_place=_place_of_name(mine),
        right_place=theirs.source,
        marked=is_open,
    )


def _place_of_name(side: SystemNode | SystemEndpoint) -> Place | None:
    """A rule of the launch file that has renamed it, else where it is made."""
    rule = side.remap if isinstance(side, SystemEndpoint) else None
    return (rule.source if rule is not None else None) or side.source


def _shown(name: str | Unknown) -> str:
    return NOT_KNOWN if isinstance(name, Unknown) else name


def _missing_end(node: str, end: SystemEndpoint, kind: Kind, other: SystemNode) -> Difference:
    """Of what is known of ``other`` it is missing; marked where not all of that is known."""
    is_left = kind is Kind.ONLY_LEFT
    entry = end.type or end.kind.value
    is_open = other.open is not None or any(
        isinstance(each.name, Unknown) and each.kind is end.kind for each in other.endpoints
    )
    return Difference(
        kind=kind,
        unit=node,
        subject=shown_end(end),
        fact=end.kind.what,
        left=entry if is_left else '',
        right='' if is_left else entry,
        left_place=end.source if is_left else None,
        right_place=None if is_left else end.source,
        marked=is_open or end.conditional or end.assumed is not None,
    )


def _missing_node(each: Placed, kind: Kind, other: System) -> Difference:
    is_left = kind is Kind.ONLY_LEFT
    entry = f'process {each.process.name}'
    place = each.node.source or each.process.launched.source
    return Difference(
        kind=kind,
        unit=shown(each.node),
        subject=shown(each.node),
        fact='node',
        left=entry if is_left else '',
        right='' if is_left else entry,
        left_place=place if is_left else None,
        right_place=None if is_left else place,
        marked=_may_be_missing(each.process)
        or any(map(_may_have_more, other.processes))
        or (each.process.outside is not None and _has_hooked_alone(other)),
    )


def _has_hooked_alone(system: System) -> bool:
    """Whether a system was recorded: what is no Python is not hooked."""
    return all(process.launched.kind == RECORDED for process in system.processes)


def _may_be_missing(process: Process) -> bool:
    return process.launched.conditional is not None or bool(process.launched.later)


def _may_have_more(process: Process) -> bool:
    """Whether a process may hold nodes that were not seen."""
    return process.outside is not None and not process.nodes and process.launched.name is None


def _unseen(left: System, matching: NodeMatching) -> Iterator[Process]:
    """Processes without a known node name."""
    seen = {id(each.process) for pair in matching.pairs for each in pair[:1]}
    seen |= {id(each.process) for each in matching.only_left}
    yield from (each for each in left.processes if id(each) not in seen and not each.nodes)


def _nameless(process: Process, other: System) -> Difference:
    why = process.outside
    return Difference(
        kind=Kind.NOT_KNOWN,
        unit=process.name,
        subject=process.name,
        fact='process',
        left=f'outside: {why.reason}' if why is not None else 'no node is found',
        left_place=process.launched.source,
        marked=True,
    )


def shown(node: SystemNode) -> str:
    """How a node is called."""
    for name in (node.name, node.own_name):
        if isinstance(name, str):
            return name
    return 'a node without a known name'


def shown_end(end: SystemEndpoint) -> str:
    """How an endpoint is called."""
    name = end.name if isinstance(end.name, str) else end.written
    kind = end.kind.value.replace('_', ' ')
    return f'{kind} {name}' if isinstance(name, str) else kind
