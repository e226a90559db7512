"""
Describe a path of the model as events: which callback, which thread, which group.

Which event an edge is stands in the templates, as the comment of the edge; here its expressions
are evaluated, and names are put for numbers. So this module knows no template, and a model of
others is described by its comments or its locations.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from typing import Any

from ros2cc_extract.checker.api import EdgeRef, Run, StateView
from ros2cc_extract.generator.events import Annotation, FieldText, read_annotation
from ros2cc_extract.generator.program_steps import gives
from ros2cc_extract.generator.unit import resources_of
from ros2cc_extract.generator.waits import actors_of, waits_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.display_names import display_names
from ros2cc_extract.spec.model import OF_LOOP, Spec
from ros2cc_extract.verify.results.events import WORDS, Event
from ros2cc_extract.verify.results.evidence import Evidence, Moment, Sentence


@dataclass(frozen=True)
class Names:
    """
    What stands for the n-th callback or activity, thread and group of a model.

    :param said: words for names, as a reader knows them.
    :param unsaid: groups that a reader does not know.
    :param resources: what is waited for, each with the names of those that end waits for it.
    """

    callbacks: tuple[str, ...] = ()
    threads: tuple[str, ...] = ()
    groups: tuple[str, ...] = ()
    executor: str = 'executor'
    places: Mapping[str, Place] = field(default_factory=dict)
    said: Mapping[str, str] = field(default_factory=dict)
    unsaid: frozenset[str] = frozenset()
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
            display_names(spec),
            frozenset(group.name for group in spec.groups if group.library == OF_LOOP),
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
        """Fields of an event about a resource; a number above the last has none."""
        if index >= len(self.resources):
            return {'resource': None}
        name, wakers = self.resources[index]
        return {'resource': name, 'wakers': wakers, 'needed': None}


def describe(run: Run, names: Names) -> Evidence:
    """
    Turn a replayed run into moments.

    Where comments are annotations, as ours are, steps without one are passed over in ``moments``;
    of a foreign model every step is described, by its comment or else by its locations.
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
            if event.group not in names.unsaid:
                yield Sentence.of(edge.process, event, names.said)


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
