"""The explored part of the state space, by state numbers in breadth-first order."""

from __future__ import annotations

from array import array
from dataclasses import field

from ros2cc_extract.light_dataclasses import dataclass

DEADLOCK, IDLE = 1, 2


@dataclass(eq=False)
class Graph:
    """
    States by number; those below ``len(offsets) - 1`` are expanded.

    :param parents: number of the state from which a state was first reached; 0 for the first.
    :param offsets: where the successors of each expanded state start in ``targets``.
    :param labels: label of each successor; empty unless fairness needs them.
    :param ends: 0, DEADLOCK or IDLE for each expanded state.
    :param masks: predicate bits of each expanded state.
    """

    parents: array[int] = field(default_factory=lambda: array('I', [0]))
    offsets: array[int] = field(default_factory=lambda: array('Q', [0]))
    targets: array[int] = field(default_factory=lambda: array('I'))
    labels: array[int] = field(default_factory=lambda: array('I'))
    ends: bytearray = field(default_factory=bytearray)
    masks: list[int] = field(default_factory=list)

    @property
    def expanded(self) -> int:
        """Number of states whose successors are known."""
        return len(self.offsets) - 1

    def successors(self, state: int) -> array[int]:
        """Return the successors of an expanded state; none of another."""
        if state >= self.expanded:
            return array('I')
        return self.targets[self.offsets[state] : self.offsets[state + 1]]

    def path_to(self, state: int) -> list[int]:
        """Return the shortest path from the initial state."""
        path = [state]
        while state:
            state = self.parents[state]
            path.append(state)
        return path[::-1]
