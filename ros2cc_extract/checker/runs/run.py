"""Witnesses and counterexamples as others see them: names instead of numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from ros2cc_extract.checker.network.interpreter import Interpreter, Memory
from ros2cc_extract.checker.network.network import Expr, Network
from ros2cc_extract.checker.network.semantics import State
from ros2cc_extract.checker.uppaal.elaboration.elaborate import Elaboration
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place


@dataclass(eq=False)
class Naming:
    """Turns states of a model into views; shared by the views of one run."""

    elaboration: Elaboration
    network: Network
    _parsed: dict[tuple[str, str | None], Expr] = field(default_factory=dict)

    def view(self, state: State) -> StateView:
        """Return a state with its names."""
        network = self.network
        return StateView(
            locations={
                process.name: process.locations[at].name
                for process, at in zip(network.processes, state.locations, strict=True)
            },
            variables={
                variable.name: value
                for variable, value in zip(network.variables, state.values, strict=True)
            },
            _state=state,
            _naming=self,
        )

    def evaluate(self, text: str, process: str | None, state: State) -> int:
        """Evaluate a UPPAAL expression in a state."""
        key = text, process
        if key not in self._parsed:
            place = Place(f'{{{text}}}', 1)
            self._parsed[key] = self.elaboration.expression(text, process, place)
        memory = Memory(list(state.locations), list(state.values))
        return Interpreter(self.elaboration.network()).value(self._parsed[key], memory)


@dataclass(frozen=True)
class StateView:
    """
    A state.

    :param locations: name of the location, by process.
    :param variables: by name, as ``group_closed[0]`` and ``executor.cur_cb_id``.
    """

    locations: Mapping[str, str]
    variables: Mapping[str, int]
    _state: State = field(repr=False, compare=False)
    _naming: Naming = field(repr=False, compare=False)

    def evaluate(self, expression: str, process: str | None = None) -> int:
        """
        Evaluate a UPPAAL expression here.

        :param process: in whose scope, with its parameters and variables; None for the global one.
        :raises ModelFormatError: the expression does not parse or has unknown names.
        """
        return self._naming.evaluate(expression, process, self._state)


@dataclass(frozen=True, kw_only=True)
class EdgeRef:
    """
    An edge that was taken.

    :param channel: with its index, as ``group_close[0]``; None without synchronisation.
    :param comment: text of the edge's comment label.
    """

    process: str
    template: str
    source: str
    target: str
    channel: str | None
    comment: str
    select: Mapping[str, int]
    place: Place


@dataclass(frozen=True)
class Step:
    """Edges that moved together, the sender first, and the state after them."""

    edges: tuple[EdgeRef, ...]
    state: StateView


@dataclass(frozen=True)
class Run:
    """
    A replayed path from the initial state.

    :param cycle_start: index of the step from which the rest is repeated forever; the last step
        leads back to the state before that step.
    :param ends: ``deadlock`` or ``idle`` (time passes forever) on maximal paths without cycle.
    """

    initial: StateView
    steps: tuple[Step, ...]
    cycle_start: int | None = None
    ends: str | None = None
