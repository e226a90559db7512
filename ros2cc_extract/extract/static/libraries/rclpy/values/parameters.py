"""
Parameters of nodes: their values are open, with a default, unless a launch has set them.

Source: rclpy 7.1.6, ``node.py``, ``parameter.py``.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import NodeState
from ros2cc_extract.extract.static.libraries.rclpy.values.declared_types import (
    DESCRIPTOR,
    note_declared,
)
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.assumed_defaults import default_of
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Handler,
    Instance,
    Mystery,
    Value,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import When

_VALUE_FIELDS = [
    'bool_value',
    'integer_value',
    'double_value',
    'string_value',
    'byte_array_value',
    'bool_array_value',
    'integer_array_value',
    'double_array_value',
    'string_array_value',
]


def _parameter(machine: RosMachine, receiver: Value, call: Call) -> Value:
    name = call.argument(0, 'name')
    default = call.argument(1, 'value')
    text = f'parameter {name.value!r}' if isinstance(name, Const) else 'a parameter'
    assert isinstance(receiver, Instance)
    known = _declared(receiver)
    if isinstance(name, Const):
        if default is not None:
            known[name.value] = default
        default = known.get(name.value)
        default = _given(machine, name.value, default)
    else:
        receiver.state.takes_any_parameter = True
    default = _usable(default_of(default))
    if isinstance(default, Const):
        text = f'{text} (default {default.value!r})'
    made = Instance(Name('rclpy.parameter.Parameter'), call.place)
    value: Value = Mystery(Unknown(f'value of {text}', call.place), text, default)
    if default is not None and _is_settled(machine, receiver, name):
        value = default
    made.state = PlainState('parameter', value)
    return made


def _declare(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``declare_parameter(name, value, descriptor, ignore_override)``."""
    if isinstance(receiver, Instance) and isinstance(receiver.state, NodeState):
        note_declared(machine, receiver, call)
    return _parameter(machine, receiver, Call(call.place, call.args[:2], call.keywords, call.more))


def _given(machine: RosMachine, name: object, default: Value | None) -> Value | None:
    """What the launch sets, before the default."""
    given = machine.world.parameters.values.get(str(name))
    if isinstance(given, tuple):
        return Sequence(tuple(Const(item) for item in given), 'list')
    return default if given is None else Const(given)


def _is_settled(machine: RosMachine, node: Instance, name: Value | None) -> bool:
    """Whether a launch sets it, and it is read before it may be set again."""
    given = machine.world.parameters
    is_given = isinstance(name, Const) and (given.are_all or str(name.value) in given.values)
    if node.state.takes_any_parameter:
        return False
    return is_given and machine.world.when is When.START and not machine.world.in_callback


def _declared(node: Instance) -> dict[object, Value]:
    """The parameters that a node has declared, with their defaults."""
    known: dict[object, Value] = node.slots.setdefault('__parameters__', {})
    return known


def _usable(default: Value | None) -> Value | None:
    """A default that says something: a type alone, ``None`` and an empty list do not."""
    if isinstance(default, Sequence):
        return default if default.items and default.rest is None else None
    return default if default != NONE else None


def _declare_all(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``declare_parameters(namespace, [(name, default, …), …])``."""
    space, rows = call.argument(0, 'namespace'), call.argument(1, 'parameters')
    items, rest = machine.items_of(rows or NONE, call.place)
    is_ignored = call.argument(2, 'ignore_override')
    made = []
    for row in items:
        parts = list(row.items) if isinstance(row, Sequence) else []
        name = parts[0] if parts else NONE
        if isinstance(space, Const) and isinstance(name, Const) and space.value:
            parts[0] = Const(f'{space.value}.{name.value}')
        named = {} if is_ignored is None else {'ignore_override': is_ignored}
        made.append(_declare(machine, receiver, Call(call.place, parts[:3], named)))
    return Sequence(tuple(made), 'list', rest)


def _get_all(machine: RosMachine, receiver: Value, call: Call) -> Value:
    items, rest = machine.items_of(call.argument(0, 'names') or NONE, call.place)
    made = [_parameter(machine, receiver, Call(call.place, [name])) for name in items]
    return Sequence(tuple(made), 'list', rest)


def _keep_parameter(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``Parameter(name, type, value)``."""
    assert isinstance(receiver, Instance)
    value = call.argument(2, 'value') or machine.mystery('value of a parameter', call.place)
    receiver.state = PlainState('parameter', value, call.argument(0, 'name'), call.place)
    return NONE


def _by_prefix(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``get_parameters_by_prefix``: whichever there are."""
    if isinstance(receiver, Instance) and isinstance(receiver.state, NodeState):
        receiver.state.takes_any_parameter = True
    return machine.mystery('parameters at run time', call.place)


def _parameter_or(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``get_parameter_or(name, alternative)``; the alternative is a parameter itself."""
    other = call.argument(1, 'alternative_value')
    state = other.state if isinstance(other, Instance) else None
    default = state.key if isinstance(state, PlainState) else None
    args = [arg for arg in (call.argument(0, 'name'), default) if arg is not None]
    return _parameter(machine, receiver, Call(call.place, args))


def _parameter_value(machine: RosMachine, receiver: Instance, place: Place) -> Value:
    state = receiver.state
    value = state.key if isinstance(state, PlainState) else None
    return value or machine.mystery('value of a parameter', place)


def _message(machine: RosMachine, receiver: Instance, place: Place) -> Value:
    made = Instance(Name('rclpy.parameter.ParameterValue'), place)
    made.state = receiver.state
    return made


class _ValueMethods(dict[str, Handler]):
    """``get_parameter_value()`` and its fields all stand for the value."""


def _get_parameter_value(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    return _message(machine, receiver, call.place)


PARAMETER_METHODS: dict[str, Handler] = {
    'declare_parameter': _declare,
    'declare_parameters': _declare_all,
    'get_parameter': _parameter,
    'get_parameters': _get_all,
    'get_parameter_or': _parameter_or,
    'get_parameters_by_prefix': _by_prefix,
}
"""What nodes do with their parameters."""

TABLE = Library(
    classes={
        'rcl_interfaces.msg.ParameterDescriptor': DESCRIPTOR,
        'rclpy.parameter.Parameter': LibraryClass(
            init=_keep_parameter,
            properties={'value': _parameter_value},
            methods={'get_parameter_value': _get_parameter_value},
        ),
        'rclpy.parameter.ParameterValue': LibraryClass(
            properties=dict.fromkeys(_VALUE_FIELDS, _parameter_value)
        ),
    },
    aliases={'rclpy.Parameter': 'rclpy.parameter.Parameter'},
)
