"""
What an unknown value is assumed to be: the default of a parameter.

Such a value stays unknown, ``Mystery``, and carries its default along, through arithmetic and
text; code that takes it says so in ``assumed``. Tests on it stay open.
"""

from __future__ import annotations

from collections.abc import Callable
from collections.abc import Sequence as Several

from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import Const, Mystery, Value

PARAMETER = 'value of parameter'
"""How the reason of what may be set from outside begins, by its name."""


def default_of(value: Value | None) -> Value | None:
    """What ``value`` is by default; itself where it is known."""
    if isinstance(value, Mystery):
        return value.default
    return value if isinstance(value, (Const, Sequence)) else None


def by_default(values: Several[Value], act: Callable[..., Value | None]) -> Value | None:
    """What ``act`` gives for the defaults of ``values``, where one is open and each has one."""
    if not any(isinstance(value, Mystery) for value in values):
        return None
    defaults = [default_of(value) for value in values]
    if any(default is None for default in defaults):
        return None
    found = act(*defaults)
    return found if isinstance(found, (Const, Sequence)) else None


def items_by_default(value: Value) -> tuple[Value, ...]:
    """The items of a list that is a default, each as open as the list; none of other values."""
    held = value.default if isinstance(value, Mystery) else None
    if not isinstance(value, Mystery) or not isinstance(held, Sequence) or held.rest is not None:
        return ()
    return tuple(_item(value, index, item) for index, item in enumerate(held.items))


def _item(value: Mystery, index: int, item: Value) -> Value:
    if not isinstance(item, (Const, Sequence)):
        return item
    return Mystery(value.unknown, f'{value.text}[{index}]', item)


def assumption(fact: str, value: Mystery) -> str:
    """The rule by which ``fact`` is assumed to be the default of ``value``."""
    reason = value.unknown.reason
    if reason.startswith(PARAMETER):
        return f'{fact} follows from {reason.removeprefix("value of ")}'
    return f'{fact} is the default of parameter {value.text!r}'
