"""A run as UPPAAL's trace layouts need it: with numbers and labels of the model as written."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from ros2cc_extract.checker.api import EdgeRef, Model, Run, StateView
from ros2cc_extract.checker.runs.printed_runs import NamedState, where_time_passes
from ros2cc_extract.checker.uppaal.files.document import TemplateNode, read_document
from ros2cc_extract.errors import InputError
from ros2cc_extract.light_dataclasses import dataclass

_MEND_LINES = 'save the model from UPPAAL, which writes each edge on lines of its own'


@dataclass(frozen=True, eq=False)
class UppaalRun:
    """
    A run with the model it is of.

    :param xml: text of the model, as it was read.
    """

    model: Model
    xml: bytes
    run: Run

    @cached_property
    def states(self) -> tuple[StateView, ...]:
        """All states; with a cycle the last one is that at its start again."""
        return (self.run.initial, *(step.state for step in self.run.steps))

    @cached_property
    def is_timeless(self) -> tuple[bool, ...]:
        """By state: whether no time can have passed until it was left."""
        named = [NamedState(state.locations, state.variables) for state in self.states]
        passes = where_time_passes(self.model, named)
        return tuple(not any(passes[: index + 1]) for index in range(len(passes)))

    @cached_property
    def templates(self) -> Mapping[str, TemplateNode]:
        """Templates as written, by process."""
        document = read_document(self.xml, self.model.name, None)
        by_name = {node.name.value.strip(): node for node in document.templates}
        return {p: by_name[self.model.template_of(p)] for p in self.model.processes}

    def edge_number(self, edge: EdgeRef) -> int:
        """
        Position of an edge among those of its template.

        :raises InputError: when two edges cannot be distinguished.
        """
        template = self.templates[edge.process]
        names = location_names(template)
        found = [
            number
            for number, node in enumerate(template.edges)
            if node.line == edge.place.line
            and (names[node.source], names[node.target]) == (edge.source, edge.target)
        ]
        if len(found) != 1:
            what = f'edges {edge.source} -> {edge.target} stand on one line'
            raise InputError(what, edge.place, _MEND_LINES)
        return found[0]


def location_names(template: TemplateNode) -> dict[str, str]:
    return {node.id: node.name or f'_{node.id}' for node in template.locations}
