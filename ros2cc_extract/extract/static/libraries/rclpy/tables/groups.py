"""
Callback groups: which group an expression stands for.

Sources: rclpy 7.1.6, ``callback_groups.py`` (classes), ``node.py`` (``None`` means the
node's default group, which is mutually exclusive).
"""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import GroupState, NodeState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Choice,
    Class,
    Instance,
    Mystery,
    Value,
    options_of,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import GroupType

BASE = 'rclpy.callback_groups.CallbackGroup'
EXCLUSIVE = 'rclpy.callback_groups.MutuallyExclusiveCallbackGroup'
REENTRANT = 'rclpy.callback_groups.ReentrantCallbackGroup'

DEFAULT_GROUP = '_default_callback_group'
_PROPERTY = 'default_callback_group'
_DECISIVE = frozenset({'can_execute', 'beginning_execution', 'ending_execution', '__new__'})


def group_type(instance: Instance) -> GroupState:
    """The state of a new group, by its class."""
    names = {cls.name for cls in instance.mro if isinstance(cls, Name)}
    kind = GroupType.REENTRANT if REENTRANT in names else GroupType.EXCLUSIVE
    state = GroupState(type=kind)
    if isinstance(instance.cls, Class):
        state.custom = instance.cls.name
        state.unresolved = _why_custom_unresolved(instance, names)
        if state.unresolved is not None:
            state.type = GroupType.EXCLUSIVE
    elif EXCLUSIVE not in names and REENTRANT not in names:
        state.custom = instance.class_name
        state.unresolved = Unknown('the abstract CallbackGroup class', instance.place)
    return state


def _why_custom_unresolved(instance: Instance, names: set[str]) -> Unknown | None:
    cls = instance.cls
    assert isinstance(cls, Class)
    if not names & {EXCLUSIVE, REENTRANT}:
        return Unknown(f'custom callback group class {cls.name}', cls.place)
    changed = [
        name
        for base in cls.mro
        if isinstance(base, Class)
        for name in base.slots
        if name in _DECISIVE
    ]
    if changed:
        return Unknown(f'custom callback group class {cls.name} overrides {changed[0]}', cls.place)
    return None


def new_group(machine: RosMachine, state: GroupState, place: Place, hint: str | None) -> Instance:
    """A group that no constructor call in the scanned text makes."""
    group = Instance(Name(REENTRANT if state.type is GroupType.REENTRANT else EXCLUSIVE), place)
    group.state = state
    group.hint = hint
    group.path = machine.world.path
    return group


def group_of(machine: RosMachine, node: Instance, value: Value | None, place: Place) -> Instance:
    """The group that ``callback_group=value`` means for an entity of ``node``."""
    default = _default_meant(machine, node, place)
    if value is None or value == NONE:
        value = default
    options = options_of(value)
    if isinstance(value, Choice):
        groups = {id(g): g for g in (_known_group(default, o) for o in options) if g}
        if len(groups) == 1 and all(_known_group(default, option) for option in options):
            return next(iter(groups.values()))
    known = _known_group(default, value)
    return known or _unknown_group(machine, value, place)


def _default_meant(machine: RosMachine, node: Instance, place: Place) -> Value:
    """What the ``create_…`` methods get by the property, which a class may override."""
    if any(isinstance(cls, Class) and _PROPERTY in cls.slots for cls in node.mro):
        return machine.attribute(node, _PROPERTY, place)
    ghost = node.state.ghost
    if ghost is not None and any(map(_overrides_the_default, machine.world.trees)):
        reason = (
            f'a class of the program overrides {_PROPERTY}; it is not known whether of this node'
        )
        return machine.mystery(reason, ghost.at or node.place)
    return default_group_of(node)


def _overrides_the_default(tree: ast.Module) -> bool:
    classes = (each for each in tree.body if isinstance(each, ast.ClassDef))
    parts = (part for cls in classes for part in cls.body)
    return any(isinstance(part, ast.FunctionDef) and part.name == _PROPERTY for part in parts)


def default_group_of(node: Instance) -> Value:
    """The default group of ``node``; a program may replace it (``node.py``, 7.1.6)."""
    state = node.state
    assert isinstance(state, NodeState)
    held = node.slots.get(DEFAULT_GROUP)
    return held if isinstance(held, Value) else state.default_group


def _known_group(default: Value, value: Value) -> Instance | None:
    if value == NONE:
        value = default
    if isinstance(value, Instance) and isinstance(value.state, GroupState):
        return value
    return None


def _unknown_group(machine: RosMachine, value: Value, place: Place) -> Instance:
    """A group of its own for each value that could not be followed, never the default one."""
    known = machine.world.unknown_groups.get(_mystery_key(value))
    if known is not None:
        return known
    state = GroupState(unresolved=Unknown(_reason(value), _at(value) or place))
    group = new_group(machine, state, _at(value) or place, None)
    group.hint = f'unresolved_{len(machine.world.unknown_groups) + 1}'
    machine.world.unknown_groups[_mystery_key(value)] = group
    machine.world.kept.append(value)
    return group


def _mystery_key(value: Value) -> object:
    if isinstance(value, Mystery):
        return (value.unknown, value.text)
    if isinstance(value, Choice):
        return tuple(_mystery_key(option) for option in options_of(value))
    return id(value)


def _reason(value: Value) -> str:
    if isinstance(value, Mystery):
        label = f'{value.text}: ' if value.text else ''
        return f'{label}{value.unknown.reason}'
    if isinstance(value, Choice):
        names = [_option_name(option) for option in options_of(value)]
        return f'one of {", ".join(names)}, depending on a branch'
    return 'not a callback group that is known'


def _option_name(value: Value) -> str:
    if value == NONE:
        return 'the default group'
    if isinstance(value, Instance):
        return value.hint or f'the group made at {value.place}'
    return value.text or 'an unknown value' if isinstance(value, Mystery) else 'another value'


def _at(value: Value) -> Place | None:
    if isinstance(value, Mystery):
        return value.unknown.at
    if isinstance(value, Choice):
        return next((at for at in map(_at, options_of(value)) if at), None)
    return value.place if isinstance(value, Instance) else None


def _make(machine: RosMachine, instance: Instance) -> GroupState:
    state = group_type(instance)
    state.count = machine.world.count
    return state


def _init(machine: RosMachine, receiver: Value, call: Call) -> Value:
    return NONE


TABLE = Library(
    classes={
        BASE: LibraryClass(state=_make, init=_init),
        EXCLUSIVE: LibraryClass(state=_make, init=_init, bases=(BASE,)),
        REENTRANT: LibraryClass(state=_make, init=_init, bases=(BASE,)),
    }
)
