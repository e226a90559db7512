"""Which part of a state an expression may read."""

from __future__ import annotations

from dataclasses import field

from ros2cc_extract.checker.network.network import (
    AtLocation,
    Call,
    DeadlockAtom,
    Element,
    Expr,
    Network,
    Var,
)
from ros2cc_extract.checker.network.traversal import function_expressions, walk
from ros2cc_extract.light_dataclasses import dataclass


@dataclass(eq=False)
class Reads:
    """Variables by slot, and processes whose location is asked for."""

    variables: set[int] = field(default_factory=set)
    processes: set[int] = field(default_factory=set)
    deadlock: bool = False


def reads_of(expr: Expr, network: Network) -> Reads:
    """Return what an expression may read, also in the functions it calls."""
    reads = Reads()
    waiting, entered = [expr], set[int]()
    while waiting:
        for node in walk(waiting.pop()):
            if isinstance(node, Var):
                reads.variables.add(node.slot)
            elif isinstance(node, Element):
                reads.variables.update(range(node.base, node.base + node.length))
            elif isinstance(node, AtLocation):
                reads.processes.add(node.process)
            elif isinstance(node, DeadlockAtom):
                reads.deadlock = True
            elif isinstance(node, Call) and node.function not in entered:
                entered.add(node.function)
                waiting += function_expressions(network.functions[node.function].body)
    return reads
