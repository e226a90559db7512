"""
``dataclass`` of the standard library, at a third of its price.

Three hundred of them are made before a command begins, which takes longer than a small check
itself. Three things make one expensive, and none is needed here: a ``__repr__`` of its own, the
functions that refuse assignments to a frozen one, and the other functions of a class that a
command never uses. So a class with ``frozen=True`` is frozen for mypy, which is shown the
original, and not while the program runs; and ``__init__``, ``__eq__`` and ``__hash__`` are
written when the first of them is called. Everything else is as in ``dataclasses``.
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
            own = dict(vars(cls))
            dataclasses.dataclass(
                cls, init=False, eq=order, order=order, repr=False, kw_only=kw_only
            )
            if '__repr__' not in own:
                cls.__repr__ = _shown
            late = ['__init__', *(['__eq__'] if eq else [])]
            if eq and own.get('__hash__') is None:
                cls.__hash__ = None
                late += ['__hash__'] if frozen else []
            _write_when_called(cls, [name for name in late if own.get(name) is None])
            return cls

        return made if cls is None else made(cls)


def _write_when_called(cls: Any, names: list[str]) -> None:
    """Put functions into ``cls`` that write those of a dataclass in their place, and call them."""

    def writing(name: str) -> Any:
        def call(value: Any, /, *args: Any, **kwargs: Any) -> Any:
            for each, function in _written(cls, names).items():
                setattr(cls, each, function)
            return getattr(cls, name)(value, *args, **kwargs)

        return call

    for name in names:
        setattr(cls, name, writing(name))


def _written(cls: Any, names: list[str]) -> dict[str, Any]:
    """
    Have the functions of a dataclass written, for a class of the same fields.

    Two threads may do so at the same time: what one puts into ``cls`` does what the other does.
    """
    own = [(each.name, object, _copied(each)) for each in dataclasses.fields(cls)]
    then = {'__post_init__': None} if hasattr(cls, '__post_init__') else {}
    made = dataclasses.make_dataclass(
        cls.__name__, own, repr=False, unsafe_hash='__hash__' in names, namespace=then
    )
    functions = {name: vars(made)[name] for name in names}
    for name, function in functions.items():
        function.__qualname__ = f'{cls.__qualname__}.{name}'
    return functions


def _copied(field: dataclasses.Field[Any]) -> Any:
    options: dict[str, Any] = {
        name: getattr(field, name)
        for name in ('default', 'default_factory', 'init', 'hash', 'compare', 'kw_only')
    }
    return dataclasses.field(**options)


def _shown(value: Any) -> str:
    """As ``dataclasses`` would write it."""
    cls: Any = type(value)
    inside = ', '.join([f'{name}={getattr(value, name)!r}' for name in _shown_fields(cls)])
    return f'{cls.__qualname__}({inside})'


@cache
def _shown_fields(cls: Any) -> tuple[str, ...]:
    return tuple(each.name for each in dataclasses.fields(cls) if each.repr)
