"""Small units to render, written as tables."""

from __future__ import annotations

from ros2cc_extract.generator.build import Profile, Text, render
from ros2cc_extract.generator.executor_kinds import ExecutorKind
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)

ENTITY = {'SRV': EntityKind.SERVICE, 'CLT': EntityKind.CLIENT}


def every_text(callbacks: str, groups: str) -> dict[str, str]:
    """Render a unit in all ways there are: XML by profile, text, executor and waits."""
    wait = f'{callbacks.partition(":")[0]}:{callbacks.rpartition(" ")[2].partition(":")[0]}'
    paper = {
        f'paper-{text.value}-{max_cycle}': render(
            closed_unit(callbacks, groups, 2), text=text, max_cycle=max_cycle
        ).xml
        for text in Text
        for max_cycle in (1, None)
    }
    rclpy = {
        f'rclpy-{kind.value}-{name}': render(
            closed_unit(callbacks, groups, 2, kind.value, waits), profile=Profile.RCLPY
        ).xml
        for kind in ExecutorKind
        for name, waits in {'': '', 'waiting': wait, 'awaiting': f'{wait}:await'}.items()
    }
    return paper | rclpy


def closed_unit(
    callbacks: str, groups: str, threads: int, executor: str | None = None, waits: str = ''
) -> ClosedSpec:
    """
    Build a unit from text: ``'scan:SUB:g tick:TMR:g'``, ``'g:EXCLUSIVE'``.

    Services and clients are entities of the name ``plan``.

    :param executor: class of the executor.
    :param waits: ``'tick:reply'`` where callback tick waits for callback reply, and
        ``'tick:reply:await'`` where it awaits it.
    """
    return close(
        Spec(
            name='arm',
            callbacks=tuple(
                Callback(
                    name=name,
                    type=CallbackType(kind),
                    group=group,
                    entity=ENTITY.get(kind),
                    key='plan' if kind in ENTITY else None,
                    blocking=tuple(_block(*row[1:]) for row in _rows(waits) if row[0] == name),
                )
                for name, kind, group in _rows(callbacks)
            ),
            groups=tuple(
                CallbackGroup(name=name, type=GroupType(kind)) for name, kind in _rows(groups)
            ),
            executor=Executor(
                name='executor',
                kind=executor,
                threads=tuple(f'thread_{index}' for index in range(threads)),
            ),
        )
    )


def _block(needed: str, call: str = 'client.call') -> Blocking:
    return Blocking(call=call, on=needed)


def _rows(text: str) -> list[list[str]]:
    return [row.split(':') for row in text.split()]
