"""
The ``.xtr`` of UPPAAL's simulator, which opens it next to the very same model.

Layout after UPPAAL's own reader, UPPAALModelChecker/tracer (``tracer.cpp`` and the sample beside
it): locations, edges and variables by number, in the order of the model; the zone as bounds
``i j 2*bound``. A model without clocks has two that UPPAAL adds: zero and the time since the
start.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ros2cc_extract.checker.api import EdgeRef, Model
from ros2cc_extract.checker.runs.printed_runs import NamedState
from ros2cc_extract.errors import InputError
from ros2cc_extract.source_locations import Place
from ros2cc_extract.verify.uppaal.run import UppaalRun, location_names


def to_xtr(run: UppaalRun) -> str:
    """
    Write what UPPAAL's simulator opens next to the very same model.

    :raises InputError: when two edges cannot be distinguished.
    """
    pieces = [_xtr_state(run, 0)]
    for index, step in enumerate(run.run.steps, start=1):
        pieces += [_xtr_state(run, index), _xtr_move(run, step.edges)]
    return ''.join([*pieces, '.\n'])


def _xtr_state(run: UppaalRun, index: int) -> str:
    state = run.states[index]
    numbers = [
        list(location_names(run.templates[process]).values()).index(location)
        for process, location in state.locations.items()
    ]
    bounds = ['0 1 0', '1 0 0'] if run.is_timeless[index] else ['0 1 0']
    zone = ''.join(f'{bound}\n.\n' for bound in bounds)
    return f'{_row(numbers)}\n.\n{zone}.\n{_row(state.variables.values())}\n.\n'


def _row(numbers: Iterable[int]) -> str:
    return ''.join(f'{number} ' for number in numbers)


def _xtr_move(run: UppaalRun, edges: Sequence[EdgeRef]) -> str:
    moves = [
        [run.model.process_index(edge.process), run.edge_number(edge), *edge.select.values()]
        for edge in edges
    ]
    return ''.join(f'{_row(move)}; ' for move in moves) + '.\n'


def read_xtr(text: str, model: Model, source: Place) -> tuple[NamedState, ...]:
    """
    Read the states of an ``.xtr``; its edges and zones are found again by a replay.

    :raises InputError: when it is not of this model, or no such file.
    """
    reader = _XtrReader(iter(text.splitlines()), model, source)
    states = [reader.state(reader.line())]
    while (line := reader.line()) != '.':
        states.append(reader.state(line))
        while not reader.line().endswith('.'):
            pass
    return tuple(states)


class _XtrReader:
    def __init__(self, lines: Iterator[str], model: Model, source: Place) -> None:
        self._lines, self._model, self._source = lines, model, source

    def line(self) -> str:
        for line in self._lines:
            return line.strip()
        raise self._error('the file ends within the run')

    def state(self, locations: str) -> NamedState:
        """Read a state whose first line was read."""
        at = self._numbers(locations, len(self._model.network.processes))
        self._dot()
        while self.line() != '.':
            self._dot()
        values = self._numbers(self.line(), len(self._model.network.variables))
        self._dot()
        return self._named(at, values)

    def _named(self, at: Sequence[int], values: Sequence[int]) -> NamedState:
        network = self._model.network
        locations = {}
        for process, number in zip(network.processes, at, strict=True):
            if not 0 <= number < len(process.locations):
                raise self._error(f'process {process.name} has no location {number}')
            locations[process.name] = process.locations[number].name
        names = (variable.name for variable in network.variables)
        return NamedState(locations, dict(zip(names, values, strict=True)))

    def _numbers(self, line: str, count: int) -> list[int]:
        words = line.split()
        if len(words) != count or not all(word.removeprefix('-').isdecimal() for word in words):
            raise self._error(f'{count} numbers expected, found {line!r}')
        return [int(word) for word in words]

    def _dot(self) -> None:
        line = self.line()
        if line != '.':
            raise self._error(f'a dot expected, found {line!r}')

    def _error(self, what: str) -> InputError:
        return InputError(what, self._source, 'give an .xtr that UPPAAL saved of this very model')
