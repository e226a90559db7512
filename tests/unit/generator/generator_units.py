"""Small units to render, written as tables."""

from __future__ import annotations

from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    Executor,
    GroupType,
    Spec,
)


def closed_unit(callbacks: str, groups: str, threads: int) -> ClosedSpec:
    """Build a unit from text: ``'scan:SUB:g tick:TMR:g'``, ``'g:EXCLUSIVE'``."""
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
                name='executor', threads=tuple(f'thread_{index}' for index in range(threads))
            ),
        )
    )


def _rows(text: str) -> list[list[str]]:
    return [row.split(':') for row in text.split()]
