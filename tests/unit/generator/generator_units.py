"""Small units to render, written as tables."""

from __future__ import annotations

from ros2cc_extract.generator.build import Profile, Text, render
from ros2cc_extract.generator.unit import ExecutorKind
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    Executor,
    GroupType,
    Spec,
)


def every_text(callbacks: str, groups: str) -> dict[str, str]:
    """Render a unit in all ways there are: XML by profile and text or executor."""
    paper = {
        f'paper-{text.value}': render(closed_unit(callbacks, groups, 2), text=text).xml
        for text in Text
    }
    rclpy = {
        f'rclpy-{kind.value}': render(
            closed_unit(callbacks, groups, 2, kind.value), profile=Profile.RCLPY
        ).xml
        for kind in ExecutorKind
    }
    return paper | rclpy


def closed_unit(
    callbacks: str, groups: str, threads: int, executor: str | None = None
) -> ClosedSpec:
    """
    Build a unit from text: ``'scan:SUB:g tick:TMR:g'``, ``'g:EXCLUSIVE'``.

    :param executor: class of the executor.
    """
    return close(
        Spec(
            name='arm',
            callbacks=tuple(
                Callback(name=name, type=CallbackType(kind), group=group)
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


def _rows(text: str) -> list[list[str]]:
    return [row.split(':') for row in text.split()]
