"""How a state is packed into the bits of one integer: locations lowest, then variables."""

from __future__ import annotations

from ros2cc_extract.checker.analyses.reads import reads_of
from ros2cc_extract.checker.network.network import Expr, Network
from ros2cc_extract.checker.network.semantics import State
from ros2cc_extract.light_dataclasses import dataclass


@dataclass(frozen=True)
class Field:
    """
    A run of bits.

    :param low: the value that is stored as 0.
    """

    shift: int
    width: int
    low: int

    @property
    def ones(self) -> int:
        """The mask of the field at bit 0."""
        return (1 << self.width) - 1

    @property
    def mask(self) -> int:
        """The mask of the field in place."""
        return self.ones << self.shift


class Layout:
    """Fields of one network's states."""

    def __init__(self, network: Network) -> None:
        self._network = network
        shift = 0
        locations, variables = [], []
        for process in network.processes:
            width = (len(process.locations) - 1).bit_length()
            locations.append(Field(shift, width, 0))
            shift += width
        self.location_mask = (1 << shift) - 1
        for variable in network.variables:
            width = (variable.high - variable.low).bit_length()
            variables.append(Field(shift, width, variable.low))
            shift += width
        self.locations = tuple(locations)
        self.variables = tuple(variables)
        self.bits = shift

    def pack(self, state: State) -> int:
        """Return the integer of a state."""
        pairs = [
            *zip(self.locations, state.locations, strict=True),
            *zip(self.variables, state.values, strict=True),
        ]
        return sum(value - field.low << field.shift for field, value in pairs)

    def unpack(self, packed: int) -> State:
        """Return the state of an integer."""
        return State(
            tuple(packed >> field.shift & field.ones for field in self.locations),
            tuple((packed >> f.shift & f.ones) + f.low for f in self.variables),
        )

    def support(self, expr: Expr) -> int:
        """Return the bits of the packed state that the value may depend on."""
        reads = reads_of(expr, self._network)
        fields = [self.variables[slot] for slot in reads.variables]
        fields += [self.locations[process] for process in reads.processes]
        bits = 0
        for field in fields:
            bits |= field.mask
        return bits
