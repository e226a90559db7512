"""
Stand-ins for interfaces that are not installed: types that rclpy takes, whose fields are anything.

A type of rclpy needs code in C for its messages (``rosidl_generator_py``). A stand-in borrows
that of an installed type without fields, so what goes over the wire is empty, and the other side
sees that type. What rclpy hands to a callback is an object of the borrowed type; it is taught to
have every field. A name in capitals is a constant; no two are equal. Actions need an
installed action, which only test packages bring.

Runs inside the user's process: the standard library, and interfaces that are installed.
"""

from __future__ import annotations

import importlib
from typing import Any

# What is borrowed for the types in `X.msg`, `X.srv` and `X.action`.
_BORROWED = {
    'msg': ('std_msgs.msg', 'Empty'),
    'srv': ('std_srvs.srv', 'Empty'),
    'action': ('test_msgs.action', 'Fibonacci'),
}
# The parts of a service and of an action that programs make and read.
_PARTS = ('Request', 'Response', 'Goal', 'Result', 'Feedback')

_constants: dict[str, Constant] = {}


class Constant(int):
    """A constant of a type that is not installed; its number is unknown."""


def constants() -> list[Constant]:
    """All that the program has asked for."""
    return list(_constants.values())


def holds_interfaces(module: str) -> bool:
    """Whether a module is one that the interfaces of a package are in (``X.msg``)."""
    parent, _, kind = module.rpartition('.')
    return bool(parent) and kind in _BORROWED


def stand_in(module: str, name: str, field: type) -> type | None:
    """
    Give a type for ``name`` of a missing module of interfaces.

    :param field: what every field is one of.
    :return: ``None`` where ``module`` holds no interfaces, or nothing can be borrowed.
    """
    if not holds_interfaces(module):
        return None
    kind = module.rpartition('.')[2]
    package, known = _BORROWED[kind]
    try:
        base = getattr(importlib.import_module(package), known)
    except ImportError:
        return None
    if kind == 'msg':
        return _message(base, field)
    parts = {part: getattr(base, part) for part in _PARTS if hasattr(base, part)}
    made = {part: _message(each, field) for part, each in parts.items()}
    found: type = _kind_over(base)(name, (base,), made)
    return found


def _kind_over(base: Any) -> Any:
    """
    Give the type of a type whose names in capitals are constants.

    Every object of the borrowed type is an instance too: what has arrived is passed on.
    """

    def missing(_cls: Any, name: str) -> Constant:
        if name.startswith('_') or not name.isupper():
            raise AttributeError(name)
        return _constants.setdefault(name, Constant(len(_constants)))

    def is_one(_cls: Any, each: Any) -> bool:
        return isinstance(each, base)

    kind = type(base)
    return type(kind.__name__, (kind,), {'__getattr__': missing, '__instancecheck__': is_one})


def _message(base: Any, field: type) -> type:
    def fill(self: Any, *_: Any, **fields: Any) -> None:
        base.__init__(self)
        vars(self).update(fields)

    def missing(_self: Any, name: str) -> Any:
        if name.startswith('__'):
            raise AttributeError(name)
        return field()

    # What arrives is of the borrowed type itself.
    base.__getattr__ = missing
    # The code in C may compare the name of the class with that which it was made for.
    named = {'__module__': base.__module__, '__qualname__': base.__qualname__}
    found: type = _kind_over(base)(base.__name__, (base,), {'__init__': fill, **named})
    return found
