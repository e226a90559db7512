"""What a reduced search does to each state: forget what is dead, order what is alike."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ros2cc_extract.checker.analyses.dead_variables import Forgetting, forget
from ros2cc_extract.checker.network.network import Network
from ros2cc_extract.checker.network.semantics import Edges, State
from ros2cc_extract.light_dataclasses import dataclass

if TYPE_CHECKING:
    from ros2cc_extract.checker.analyses.symmetry import Family


@dataclass(frozen=True)
class Reducer:
    """
    The reductions of one search, in plain Python; the core does the same.

    :param forgotten: by process; empty if nothing is forgotten.
    """

    network: Network
    forgotten: tuple[Forgetting, ...]
    families: tuple[Family, ...]

    def forget(self, state: State, edges: Edges) -> State:
        """Reset what is dead where the processes of ``edges`` have arrived."""
        return forget(self.forgotten, state, edges) if self.forgotten else state

    def canonical(self, state: State) -> State:
        """Return the one state that stands for all that differ only by an exchange of members."""
        for family in self.families:
            state = self._sorted(family, state)
        return state

    def _sorted(self, family: Family, state: State) -> State:
        alive = [p for p in family.pointers if not is_dead(p, state, self.forgotten)]
        members = range(len(family.processes))

        def key(member: int) -> tuple[int, ...]:
            return (
                state.locations[family.processes[member]],
                *(state.values[slot] for slot in family.parts[member]),
                *(int(state.values[slot] == family.names[member]) for slot in alive),
            )

        order = sorted(members, key=key)
        locations, values = list(state.locations), list(state.values)
        for to, of in zip(members, order, strict=True):
            locations[family.processes[to]] = state.locations[family.processes[of]]
            for target, source in zip(family.parts[to], family.parts[of], strict=True):
                values[target] = state.values[source]
        for slot in family.pointers:
            if slot not in alive:
                values[slot] = self.network.variables[slot].initial
            elif values[slot] in family.names:
                values[slot] = family.names[order.index(family.names.index(values[slot]))]
        return State(tuple(locations), tuple(values))


def is_dead(slot: int, state: State, forgotten: Sequence[Forgetting]) -> bool:
    """Whether a variable is forgotten where some process is."""
    for at, own in zip(state.locations, forgotten, strict=False):
        node = at, tuple(state.values[control] for control in own.controls)
        if any(slot == reset for reset, _ in own.resets.get(node, ())):
            return True
    return False
