"""
``dataclass`` of the standard library, at half of its price.

Three hundred of them are made before a command begins, which takes longer than a small check
itself. Two things make one expensive, and neither is needed here: a ``__repr__`` of its own, and
the functions that refuse assignments to a frozen one. So a class with ``frozen=True`` is frozen
for mypy, which is shown the original, and not while the program runs; its values also take less
time to make. Everything else is as in ``dataclasses``.
"""

from __future__ import annotations

import dataclasses
from functools import cache
from typing import TYPE_CHECKING, Any

__all__ = ['dataclass']

if TYPE_CHECKING:
    from dataclasses import dataclass
else:

    def dataclass(cls=None, /, *, eq=True, order=False, frozen=False, kw_only=False):
        """Make a dataclass; see the module."""

        def made(cls):
            own = vars(cls)
            shows_itself = '__repr__' in own
            hashes_itself = own.get('__hash__') is not None
            result = dataclasses.dataclass(
                cls,
                eq=eq,
                order=order,
                repr=False,
                unsafe_hash=frozen and eq and not hashes_itself,
                kw_only=kw_only,
            )
            if not shows_itself:
                result.__repr__ = _shown
            return result

        return made if cls is None else made(cls)


def _shown(value: Any) -> str:
    """As ``dataclasses`` would write it."""
    cls: Any = type(value)
    inside = ', '.join([f'{name}={getattr(value, name)!r}' for name in _shown_fields(cls)])
    return f'{cls.__qualname__}({inside})'


@cache
def _shown_fields(cls: Any) -> tuple[str, ...]:
    return tuple(each.name for each in dataclasses.fields(cls) if each.repr)
