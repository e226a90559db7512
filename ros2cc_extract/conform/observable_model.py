"""
The model of a unit as something whose steps can be observed.

The network that the generator's text describes is the only semantics here. This module names
its edges: by template, locations and the event that they are, it finds which of them an
observer of the executor sees, and for which callback.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.checker.api import Model
from ros2cc_extract.checker.engines.generated_successors import Moving, Plan
from ros2cc_extract.checker.engines.state_layout import Field, Layout
from ros2cc_extract.checker.network.network import Edge, Network, Process
from ros2cc_extract.checker.network.semantics import Edges, Semantics
from ros2cc_extract.conform.observations import Act
from ros2cc_extract.generator.events import read_annotation
from ros2cc_extract.light_dataclasses import dataclass

#: Template, location before and after, event: what is seen.
_SEEN = (
    ('Executor', 'wait', 'serving', 'wake', Act.WAKE),
    ('Executor', 'serving', 'serving', 'queue', Act.COLLECT),
    ('Executor', 'serving', 'executing', None, Act.COLLECT),
    ('Thread', 'popped', 'running', 'start', Act.BEGIN),
    ('Thread', 'assigned', 'running', 'start', Act.BEGIN),
    ('Thread', 'idle', 'running', 'start', Act.BEGIN),
    ('Thread', 'spinning', 'spinning', 'wake', Act.WAKE),
    ('Thread', 'spinning', 'spinning', 'queue', Act.COLLECT),
    ('Thread', 'spinning', 'entering', None, Act.COLLECT),
    ('Thread', 'entering', 'running', 'start', Act.BEGIN),
    ('Thread', 'spinning', 'running', 'go_on resumed', Act.RESUME),
    ('Thread', 'running', 'leaving', 'end', Act.END),
    ('Thread', 'running', 'leaving', 'await', Act.SUSPEND),
    ('Thread', 'running', 'leaving', 'await outside', Act.SUSPEND),
    ('Thread', 'popped', 'idle', 'refuse', Act.REFUSED),
    ('Thread', 'running', 'idle', 'end', Act.END),
    ('Thread', 'running', 'idle', 'await', Act.SUSPEND),
    ('Thread', 'running', 'idle', 'await outside', Act.SUSPEND),
    ('Thread', 'popped', 'running', 'go_on resumed', Act.RESUME),
    ('Thread', 'assigned', 'running', 'go_on resumed', Act.RESUME),
    ('Thread', 'idle', 'running', 'go_on resumed', Act.RESUME),
    ('Callback', 'source', 'source', None, Act.ARRIVE),
)
_ON_A_THREAD = (Act.BEGIN, Act.REFUSED, Act.END, Act.SUSPEND, Act.RESUME)


@dataclass(frozen=True)
class Label:
    """
    What is seen of a step.

    :param act: ``None`` when nothing is seen.
    :param callback: its place; ``None`` where the state has it (see ``process``).
    :param process: number of the process that takes the step.
    """

    act: Act | None
    callback: int | None
    process: int


@dataclass(frozen=True)
class Move:
    """
    A step of the model as an observer sees it.

    :param taken: places of the callbacks whose data was taken.
    """

    act: Act | None
    callback: int | None
    taken: frozenset[int]
    target: int


class ObservedModel:
    """
    Steps of one model, from packed state to packed state.

    :param unseen_collects: places of callbacks whose collection no trace shows.
    """

    def __init__(self, model: Model, callbacks: int, unseen_collects: frozenset[int]) -> None:
        self._unseen_collects = unseen_collects
        self.network: Network = model.network
        self.layout = Layout(self.network)
        self._moving = Moving(self.network, self.layout)
        self._plans: dict[int, Plan] = {}
        self._labels: dict[int, Label] = {}
        self._fields = {
            variable.name: field
            for variable, field in zip(self.network.variables, self.layout.variables, strict=True)
        }
        self._waiting = [self._fields[f'cb_waiting[{c}]'] for c in range(callbacks)]
        self._waiting_bits = sum(field.mask for field in self._waiting)
        self._assigned = {
            process: self._fields[f'thread_cb_assign_table[{number}]']
            for number, process in enumerate(self.processes('Thread'))
        }
        self._source_of = {
            process: number for number, process in enumerate(self.processes('Callback'))
        }
        self._moves: dict[int, list[Move]] = {}
        first = next(iter(self._assigned))
        names = [location.name for location in self.network.processes[first].locations]
        self._idle = names.index('idle')
        self._threads = [self._thread_fields(process) for process in self._assigned]
        self._thread_bits = sum(
            field.mask
            for at, own in self._threads
            for field in (at, *own)
            if len(self._threads) > 1
        )
        self._tasks = [
            (self._waiting[task], self._fields[f'cb_queued[{task}]'])
            for task in sorted(unseen_collects)
            if f'cb_queued[{task}]' in self._fields
        ]

    def initial(self) -> int:
        """The packed initial state."""
        return self.layout.pack(Semantics(self.network).initial())

    def value(self, packed: int, name: str) -> int | None:
        """A variable by name; ``None`` when the model has none of that name."""
        field = self._fields.get(name)
        return None if field is None else _read(packed, field)

    @property
    def has_waits(self) -> bool:
        """Whether its executor waits for many at a time, and not for one event after the other."""
        return self._fields.keys().isdisjoint(('event_count', 'ready_count'))

    @property
    def has_nested_spins(self) -> bool:
        """Whether callbacks run inside others that spin their executor."""
        return 'thread_nested[0]' in self._fields

    def is_waiting(self, packed: int, callback: int) -> bool:
        """Whether something has arrived for a callback and was not taken."""
        return _read(packed, self._waiting[callback]) > 0

    def collects_unseen(self, packed: int, callback: int) -> bool:
        """Whether nothing shows that it was collected: coroutines are asked again and again."""
        if callback in self._unseen_collects:
            return True
        field = self._fields.get(f'cb_suspended[{callback}]')
        return field is not None and _read(packed, field) > 0

    def processes(self, template: str) -> list[int]:
        """Numbers of the processes made from a template."""
        return [n for n, p in enumerate(self.network.processes) if p.template == template]

    def location(self, packed: int, process: int) -> str:
        """Name of the location that a process is in."""
        at = _read(packed, self.layout.locations[process])
        return self.network.processes[process].locations[at].name

    @property
    def has_tasks(self) -> bool:
        """Whether tasks are handed over to a pool."""
        return bool(self._tasks)

    def unserved_tasks(self, packed: int) -> int:
        """How many tasks of a pool are made, and not handed over to it."""
        return sum(_read(packed, made) - _read(packed, queued) for made, queued in self._tasks)

    def _thread_fields(self, process: int) -> tuple[Field, list[Field]]:
        """Where a thread is, and all else that is its own."""
        own = self.network.processes[process].name
        number = list(self._assigned).index(process)
        names = [
            name
            for name in self._fields
            if name.startswith(f'{own}.')
            or (name.startswith('thread_') and name.endswith(f'[{number}]'))
        ]
        return self.layout.locations[process], [self._fields[name] for name in names]

    def _sorted_threads(self, before: int, packed: int) -> int:
        """Name threads anew: which of them does something makes no difference."""
        if not (before ^ packed) & self._thread_bits:
            return packed
        states = []
        for at, fields in self._threads:
            where = _read(packed, at)
            idle = self._idle == where
            states.append((where, *(0 if idle else _raw(packed, each) for each in fields)))
        states.sort(key=lambda state: (state[0] == self._idle, state))
        for (at, fields), values in zip(self._threads, states, strict=True):
            for each, value in zip((at, *fields), values, strict=True):
                packed ^= (_raw(packed, each) ^ value) << each.shift
        return packed

    def moves(self, packed: int) -> list[Move]:
        """All steps from a state, in the model's order."""
        known = self._moves.get(packed)
        if known is None:
            if len(self._moves) > 50_000:
                self._moves.clear()
            known = self._moves[packed] = list(self._find(packed))
        return known

    def _find(self, packed: int) -> Iterator[Move]:
        for target, label in self._targets(packed):
            seen = self._label(label)
            callback = seen.callback
            if callback is None and seen.act in _ON_A_THREAD:
                callback = _read(packed, self._assigned[seen.process])
            taken = self._taken(packed, target) if seen.act is not Act.ARRIVE else frozenset()
            yield Move(seen.act, callback, taken, self._sorted_threads(packed, target))

    def _targets(self, packed: int) -> Iterator[tuple[int, int]]:
        at = packed & self.layout.location_mask
        plan = self._plans.get(at)
        if plan is None:
            plan = self._plans[at] = self._moving.plan(packed)
        for move, label in plan.steps:
            if label < 0:
                yield from move(packed)
            else:
                target = move(packed)
                if target >= 0:
                    yield target, label

    def _taken(self, before: int, after: int) -> frozenset[int]:
        if not (before ^ after) & self._waiting_bits:
            return frozenset()
        return frozenset(
            place
            for place, field in enumerate(self._waiting)
            if _read(after, field) < _read(before, field)
        )

    def _label(self, number: int) -> Label:
        if number not in self._labels:
            self._labels[number] = self._read_label(self._moving.labels[number])
        return self._labels[number]

    def _read_label(self, edges: Edges) -> Label:
        for process, number in edges:
            owner = self.network.processes[process]
            edge = owner.edges[number]
            act = _act_of(owner, edge)
            if act is Act.ARRIVE:
                return Label(act, self._source_of[process], process)
            if act is not None:
                return Label(act, dict(edge.select).get('c'), process)
        return Label(None, None, edges[0][0])


def _act_of(process: Process, edge: Edge) -> Act | None:
    source, target = process.locations[edge.source].name, process.locations[edge.target].name
    place = process.template, source, target
    event = read_annotation(edge.comment)
    keys = (None, event.key if event else None)
    fitting = (row for row in _SEEN if row[:3] == place and row[3] in keys)
    return next((act for *_, act in fitting), None)


def _raw(packed: int, field: Field) -> int:
    return packed >> field.shift & field.ones


def _read(packed: int, field: Field) -> int:
    return (packed >> field.shift & field.ones) + field.low
