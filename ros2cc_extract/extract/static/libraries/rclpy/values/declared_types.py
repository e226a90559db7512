"""
The types of the parameters that a node declares.

Source: rclpy 7.1.6, ``node.py`` (``declare_parameters``: the type is that of the value, or the one
that stands in its place; none with ``dynamic_typing``, and what a launch sets does not count with
``ignore_override``), ``parameter.py`` (``Parameter.Type.from_parameter_value``).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import LibraryClass
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.exclusive_paths import beyond
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Instance,
    Library,
    Value,
)
from ros2cc_extract.spec.node_graph import DeclaredParameter
from ros2cc_extract.spec.system.parameter_types import BYTES, type_of

_SLOT, _DYNAMIC = '__declared__', 'dynamic_typing'
_TYPES = {
    'BOOL': 'bool',
    'INTEGER': 'integer',
    'DOUBLE': 'double',
    'STRING': 'string',
    'BYTE_ARRAY': BYTES,
    'BOOL_ARRAY': 'bool array',
    'INTEGER_ARRAY': 'integer array',
    'DOUBLE_ARRAY': 'double array',
    'STRING_ARRAY': 'string array',
}


def note_declared(machine: RosMachine, node: Instance, call: Call) -> None:
    """Keep the type of a parameter, where what a launch sets must be of it."""
    name = call.argument(0, 'name')
    type_name = _type(call)
    if isinstance(name, Const) and isinstance(name.value, str) and type_name is not None:
        is_open = machine.world.in_callback or bool(beyond(machine.world.path, node.path))
        known: dict[str, DeclaredParameter] = node.slots.setdefault(_SLOT, {})
        known[name.value] = DeclaredParameter(
            name=name.value, type=type_name, source=call.place, conditional=is_open
        )


def declared_in(node: Instance) -> tuple[DeclaredParameter, ...]:
    """What a node declares with a type."""
    return tuple(node.slots.get(_SLOT, {}).values())


def _type(call: Call) -> str | None:
    ignores = call.argument(3, 'ignore_override')
    if ignores not in (None, Const(False)) or _may_be_dynamic(call.argument(2, 'descriptor')):
        return None
    return _type_of(call.argument(1, 'value'))


def _may_be_dynamic(descriptor: Value | None) -> bool:
    if descriptor is None or descriptor == NONE:
        return False
    state = descriptor.state if isinstance(descriptor, Instance) else None
    if not isinstance(descriptor, Instance) or not isinstance(state, PlainState):
        return True
    later = descriptor.slots.get(_DYNAMIC)
    return (later if later is not None else state.key) not in (None, Const(False))


def _type_of(value: Value | None) -> str | None:
    if isinstance(value, Library):
        of, _, last = value.name.rpartition('.')
        return _TYPES.get(last) if of.endswith('Parameter.Type') else None
    if isinstance(value, Const):
        return type_of(value.value)
    if isinstance(value, Sequence) and value.rest is None and value.kind in ('list', 'tuple'):
        items = [item.value for item in value.items if isinstance(item, Const)]
        is_known = len(items) == len(value.items)
        return (type_of(tuple(items)) if items else BYTES) if is_known else None
    return None


def _keep_descriptor(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``ParameterDescriptor(…)``; of what is passed on nothing is known."""
    assert isinstance(receiver, Instance)
    unknown = machine.mystery('options of a descriptor', call.place) if call.more else None
    receiver.state = PlainState('descriptor', call.keywords.get(_DYNAMIC, unknown))
    return NONE


DESCRIPTOR = LibraryClass(init=_keep_descriptor)
