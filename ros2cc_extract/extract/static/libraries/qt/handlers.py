"""
Methods that Qt calls because a class overrides them: its handlers of events.

Source: Qt 6, ``QObject`` (``event``, ``eventFilter``), ``QWidget`` (*Event Handlers*: all others
have names that end so).
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.static.libraries.qt.threads import BINDINGS
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Class,
    Function,
    Instance,
    Library,
)

_OTHERS = frozenset({'event', 'eventFilter'})


def handlers_of(instance: Instance) -> Iterator[tuple[Bound, str]]:
    """Those of an object, each with the name of the class that calls it."""
    base = next((name for name in map(_name_of, instance.mro) if name), '')
    scanned = (cls for cls in instance.mro if isinstance(cls, Class)) if base else ()
    for cls in scanned:
        for name, value in cls.slots.items():
            is_handler = name in _OTHERS or name.endswith('Event')
            if is_handler and isinstance(value, Function):
                yield Bound(instance, value), base


def _name_of(cls: object) -> str:
    """The name of a class of Qt."""
    name = cls.name if isinstance(cls, Library) else ''
    return name if name.partition('.')[0] in BINDINGS else ''
