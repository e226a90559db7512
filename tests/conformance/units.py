"""The specification of a random program, as somebody who knows it would write it."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Origin,
    Spec,
)
from tests.conformance import programs
from tests.conformance.programs import Entity, Program

_WAITS = {'call': 'client.call', 'wait': 'Event.wait'}
ANSWERING = 'answering'
NO_GROUP = 'no_group'


def spec_of(program: Program) -> Spec:
    """Write down all that the program's text says."""
    groups = [
        CallbackGroup(
            name=f'g{number}', type=GroupType.REENTRANT if g.reentrant else GroupType.EXCLUSIVE
        )
        for number, g in enumerate(program.groups)
    ]
    has_tasks = any(e.kind == programs.TASK for e in program.entities)
    if has_tasks or any(d.what == 'call' for e in program.entities for d in e.effects):
        groups.append(CallbackGroup(name=NO_GROUP, type=GroupType.REENTRANT, groupless=True))
    return Spec(
        name=f'p{programs.label(program.seed)}',
        callbacks=tuple(_callbacks(program)),
        groups=tuple(groups),
        executor=Executor(
            name='executor',
            kind=program.executor,
            threads=tuple(f'thread_{t}' for t in range(program.threads)),
        ),
        origin=Origin.MANUAL,
        nodes=tuple(program.node_name(n) for n in range(program.nodes)),
    )


def _callbacks(program: Program) -> Iterator[Callback]:
    for entity in program.entities:
        kind = EntityKind(entity.kind)
        is_task = kind is EntityKind.TASK
        yield Callback(
            name=entity.name,
            type=kind.published_type,
            group=NO_GROUP if is_task else f'g{entity.group}',
            entity=kind,
            node=program.node_name(entity.node),
            function=f'p{programs.label(program.seed)}.{entity.name}'
            if kind is not EntityKind.CLIENT
            else None,
            key=_key(program, entity),
            period_s=entity.period_s if kind is EntityKind.TIMER else None,
            coroutine=any(effect.what.startswith('await') for effect in entity.effects),
            groupless=is_task,
            blocking=tuple(_blocking(entity)),
        )
    # What ``Built._call`` sets its event by.
    for entity in program.entities:
        if any(effect.what == 'call' for effect in entity.effects):
            yield Callback(
                name=f'answered_{entity.number}',
                type=EntityKind.DONE_CALLBACK.published_type,
                group=NO_GROUP,
                entity=EntityKind.DONE_CALLBACK,
                function='Built._call.<locals>.<lambda>',
                groupless=True,
            )


def _key(program: Program, entity: Entity) -> str | None:
    if entity.kind == programs.CLIENT:
        server = programs.server_of(program, entity)
        return server.key if server else ANSWERING
    return entity.key if entity.kind in (programs.SUBSCRIPTION, programs.SERVICE) else None


def _blocking(entity: Entity) -> Iterator[Blocking]:
    for effect in entity.effects:
        if effect.what.startswith('await'):
            yield Blocking(call='await', on=f'c{effect.on}')
        elif effect.what == 'spin_call':
            place = Place('driver.py', effect.on + 1)
            how = 'executor.spin_until_future_complete'
            yield Blocking(call=how, on='executor', source=place)
            yield Blocking(call='spin for future', on=f'c{effect.on}', source=place)
        elif effect.what in _WAITS:
            yield Blocking(call=_WAITS[effect.what], on=f'c{effect.on}')
