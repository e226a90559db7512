"""What an extractor returns, whichever source it read."""

from __future__ import annotations

from ros2cc_extract.diagnostics import Diagnostic
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.joined_executors import Joined
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.node_graph import NodeGraph


@dataclass(frozen=True)
class Extraction:
    """
    The units found, what was noticed on the way, and which files were looked at.

    :param units: one per executor, in the order of the files and of the lines in them.
    :param diagnostics: sorted by place.
    :param files_seen: every file that was read, as shown to the user.
    :param joined: units of one program that wait for each other, as one.
    :param wholes: all units of one program in one, where it has several.
    :param idle: units without any callback; they have no model.
    :param nodes: what the nodes of each entry have in the graph.
    :param cut: why not all was followed to its end; empty where it was.
    :param interrupted: it was ended early.
    """

    units: tuple[Spec, ...]
    diagnostics: tuple[Diagnostic, ...]
    files_seen: tuple[str, ...]
    joined: tuple[Joined, ...] = ()
    wholes: tuple[Spec, ...] = ()
    idle: tuple[Spec, ...] = ()
    nodes: tuple[NodeGraph, ...] = ()
    cut: str = ''
    interrupted: bool = False
