"""
Names of what is one object in the whole program, for all its users.

An attribute of a node is known by the class of that node: two nodes of one class have two. Helper
objects are distinguished by numbers, and variables of modules exist once.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from ros2cc_extract.findings.base.rule import Doer
from ros2cc_extract.spec.effects import Access
from ros2cc_extract.spec.model import Callback, Spec


def node_classes(units: Iterable[Spec]) -> frozenset[str] | None:
    """The classes of the nodes; ``None`` if that is not known of all that matter."""
    doers: list[Doer] = []
    for unit in units:
        doers += (*unit.callbacks, *unit.activities)
    if any(each.cls is None and each.writes and isinstance(each, Callback) for each in doers):
        return None
    return frozenset(doer.cls for doer in doers if doer.cls is not None)


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
