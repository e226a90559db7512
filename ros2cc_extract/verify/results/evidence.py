"""
Tells a path of the model as events: which callback, which thread, which group.

Which event an edge is stands in the templates, as the comment of the edge; here its expressions
are evaluated, and names are put for numbers. So this module knows no template, and a model of
somebody else is told by its comments or its locations.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from ros2cc_extract.checker.api import EdgeRef, Run, StateView
from ros2cc_extract.generator.events import Annotation, FieldText, read_annotation
from ros2cc_extract.generator.program_steps import gives
from ros2cc_extract.generator.unit import resources_of
from ros2cc_extract.generator.waits import actors_of, waits_of
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.events import WORDS, Event
from ros2cc_extract.verify.uppaal.run import UppaalRun


@dataclass(frozen=True)
class Sentence:
    """
    What one process does in a step.

    :param lane: name of the process whose edge it is: a thread, the executor, a group …
    :param event: what it is; ``None`` in a model of somebody else.
    """

    lane: str
    text: str
    event: Event | None = None

    @staticmethod
    def of(lane: str, event: Event) -> Sentence:
        """Say an event."""
        return Sentence(lane, event.words, event)


@dataclass(frozen=True, kw_only=True)
class Moment:
    """
    One step of a run that means something to a developer.

    :param number: 1-based, counts told steps only.
    :param sentences: one per edge that has words.
    :param places: of the callbacks named, in the order of naming.
    :param changes: variables and locations that changed, with their new values.
    :param edges: what was taken, by locations; of ``Evidence.steps`` alone.
    """

    number: int
    sentences: tuple[Sentence, ...]
    places: tuple[tuple[str, Place], ...]
    changes: Mapping[str, int | str]
    edges: tuple[str, ...] = ()

    @property
    def events(self) -> tuple[Event, ...]:
        """What happens in it; nothing in a model of somebody else."""
        return tuple(s.event for s in self.sentences if s.event is not None)


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """
    A run that shows why a verdict is as it is.

    :param start: location of every process before the first moment.
    :param cycle_from: number of the moment from which the run repeats for ever.
    :param ends: how a run without a cycle ends for good (``deadlock``, ``idle``), if it does.
    :param left_out: how many moments are not among ``moments``, since they have no part in it.
    :param closing: what the run ends in, in a sentence.
    :param steps: every step that was taken, also those without words, in the same form.
    :param cycle_step: number of the step from which the run repeats for ever.
    :param origin: the run that was told, step by step; it stays behind when evidence is pickled,
        as it holds the whole model.
    """

    start: Mapping[str, str]
    moments: tuple[Moment, ...]
    cycle_from: int | None
    ends: str | None
    left_out: int = 0
    closing: str = ''
    steps: tuple[Moment, ...] = ()
    cycle_step: int | None = None
    origin: UppaalRun | None = field(default=None, repr=False, compare=False)

    def __getstate__(self) -> dict[str, object]:
        return {**self.__dict__, 'origin': None}


LOST = Evidence(
    start={},
    moments=(),
    cycle_from=None,
    ends=None,
    closing='this run was not found again within the limits',
)
"""Of a search that was slower the second time, with as little time as the first."""


@dataclass(frozen=True)
class Names:
    """
    What stands for the n-th callback or activity, thread and group of a model.

    :param resources: what is waited for, each with the names of those who end waits for it.
    """

    callbacks: tuple[str, ...] = ()
    threads: tuple[str, ...] = ()
    groups: tuple[str, ...] = ()
    executor: str = 'executor'
    places: Mapping[str, Place] = field(default_factory=dict)
    resources: tuple[tuple[str, tuple[str, ...]], ...] = ()

    @staticmethod
    def of(spec: Spec) -> Names:
        """Names and places of a unit, in the order in which the model numbers them."""
        actors = tuple(actors_of(spec))
        steps = {actor.name: tuple(waits_of(actor, spec)) for actor in actors}
        places = {actor.name: actor.defined or actor.source for actor in actors}
        return Names(
            tuple(actor.name for actor in actors),
            spec.executor.threads,
            tuple(group.name for group in spec.groups),
            spec.executor.name,
            {name: place for name, place in places.items() if place is not None},
            tuple(
                (resource.name, tuple(n for n, own in steps.items() if gives(own, resource)))
                for resource in resources_of(steps)
            ),
        )

    def lookup(self, kind: str, index: int) -> str:
        """Name of the ``index``-th callback, thread or group."""
        names = {'callback': self.callbacks, 'thread': self.threads, 'group': self.groups}[kind]
        return names[index] if 0 <= index < len(names) else f'{kind} {index}'

    def resource(self, index: int) -> dict[str, object]:
        """Fields of an event about a resource; a number behind the last is none."""
        if index >= len(self.resources):
            return {'resource': None}
        name, wakers = self.resources[index]
        return {'resource': name, 'wakers': wakers, 'needed': None}


def tell(run: Run, names: Names) -> Evidence:
    """
    Turn a replayed run into moments.

    Where comments are annotations, as ours are, steps without one are passed over in ``moments``;
    of a model of somebody else every step is told, by its comment or else by its locations.
    """
    edges = (edge for step in run.steps for edge in step.edges)
    is_ours = any(map(_annotation_of, edges))
    moments: list[Moment] = []
    steps: list[Moment] = []
    cycle_from: int | None = None
    before = run.initial
    changes: dict[str, int | str] = {}
    for index, step in enumerate(run.steps):
        if index == run.cycle_start:
            cycle_from = len(moments) + 1
        own = _changes(before, step.state)
        changes |= own
        sentences = tuple(
            _spoken(step.edges, before, step.state, names)
            if is_ours
            else map(_located, step.edges)
        )
        before = step.state
        places = tuple(_places(sentences, names))
        steps.append(
            Moment(
                number=index + 1,
                sentences=sentences,
                places=places,
                changes=own,
                edges=tuple(f'{e.process}: {e.source} -> {e.target}' for e in step.edges),
            )
        )
        if sentences:
            moments.append(
                Moment(
                    number=len(moments) + 1, sentences=sentences, places=places, changes=changes
                )
            )
            changes = {}
    if cycle_from is not None and cycle_from > len(moments):
        cycle_from = None
    return Evidence(
        start=dict(run.initial.locations),
        moments=tuple(moments),
        cycle_from=cycle_from,
        ends=run.ends,
        steps=tuple(steps),
        cycle_step=None if run.cycle_start is None else run.cycle_start + 1,
    )


def _annotation_of(edge: EdgeRef) -> Annotation | None:
    annotation = read_annotation(edge.comment)
    return annotation if annotation is not None and annotation.key in WORDS else None


def _spoken(
    edges: Iterable[EdgeRef], before: StateView, after: StateView, names: Names
) -> Iterator[Sentence]:
    for edge in edges:
        annotation = _annotation_of(edge)
        if annotation is not None:
            event = _evaluated(annotation, edge.process, before, after, names)
            yield Sentence.of(edge.process, event)


def _evaluated(
    annotation: Annotation, process: str, before: StateView, after: StateView, names: Names
) -> Event:
    def value(field: FieldText) -> int | str:
        if field.noun == 'executor':
            return names.executor
        state = before if field.is_before else after
        number = state.evaluate(field.expression, process)
        is_name = field.noun in ('callback', 'thread', 'group')
        return names.lookup(field.noun, number) if is_name else number

    values: dict[str, Any] = {field.name: value(field) for field in annotation.fields}
    if 'resource' in values:
        values |= names.resource(values['resource'])
    return Event(kind=annotation.kind, form=annotation.form, **values)


def _located(edge: EdgeRef) -> Sentence:
    if edge.comment:
        return Sentence(edge.process, f'{edge.process}: {" ".join(edge.comment.split())}')
    channel = f' ({edge.channel})' if edge.channel else ''
    return Sentence(edge.process, f'{edge.process}: {edge.source} -> {edge.target}{channel}')


def _places(sentences: tuple[Sentence, ...], names: Names) -> Iterator[tuple[str, Place]]:
    named = [name for s in sentences if s.event is not None for name in s.event.mentions]
    for name in dict.fromkeys(named):
        if name in names.places:
            yield name, names.places[name]


def _changes(before: StateView, after: StateView) -> dict[str, int | str]:
    changed: dict[str, int | str] = {
        process: location
        for process, location in after.locations.items()
        if before.locations[process] != location
    }
    for name, value in after.variables.items():
        if before.variables[name] != value:
            changed[name] = value
    return changed
