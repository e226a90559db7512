"""
Names of what is one object in the whole program, for all its users.

An attribute of a node is known by the class of that node: two nodes of one class have two. Of a
class with one node there is one. Helper objects are distinguished by numbers, and variables of
modules exist once.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from ros2cc_extract.findings.base.rule import Doer
from ros2cc_extract.spec.effects import Access
from ros2cc_extract.spec.model import Callback, Origin, Spec


def node_classes(units: Iterable[Spec]) -> frozenset[str] | None:
    """The classes of which there are several nodes; ``None`` if that is not known."""
    nodes: dict[str, set[object]] = {}
    for unit in units:
        doers: tuple[Doer, ...] = (*unit.callbacks, *unit.activities)
        for doer in doers:
            if doer.cls is not None:
                nodes.setdefault(doer.cls, set()).update(_nodes_of(doer, unit))
            elif unit.origin is not Origin.STATIC and doer.writes and isinstance(doer, Callback):
                return None  # the scanner knows the class of each node but rclpy's own
    return frozenset(cls for cls, known in nodes.items() if len(known) > 1)


def _nodes_of(doer: Doer, unit: Spec) -> tuple[object, ...]:
    """Its node, and one more where it stands for several."""
    is_one = isinstance(doer.node, str) and doer.count == 1
    return (doer.node,) if is_one else (doer.node, (unit.name, doer.name))


def shared_part(doer: Doer, classes: frozenset[str] | None) -> Doer:
    """What ``doer`` does to objects that are no nodes; nothing where nodes are not known."""
    if classes is None:
        return replace(doer, reads=(), writes=(), pieces=())
    return replace(
        doer,
        reads=tuple(read for read in doer.reads if _is_shared(read, classes)),
        writes=tuple(write for write in doer.writes if _is_shared(write, classes)),
        pieces=tuple(piece for piece in doer.pieces if _is_shared(piece, classes)),
    )


def _is_shared(access: Access, classes: frozenset[str]) -> bool:
    owner = access.name.rpartition('.')[0]
    return owner.partition('#')[0] not in classes
