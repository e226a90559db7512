"""What callback values are called; ``extract/names.py`` makes such names unique."""

from __future__ import annotations

import ast
import re

from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Choice,
    Class,
    Const,
    Function,
    Instance,
    Library,
    Mystery,
    Native,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown


@dataclass(frozen=True)
class FunctionFacts:
    """
    What a callback value says of itself.

    :param label: short name to build the callback's name from.
    """

    label: str
    function: str | None = None
    defined: Place | None = None
    coroutine: bool = False
    unresolved: Unknown | None = None


def describe(value: Value | None, place: Place) -> FunctionFacts:
    """The facts of a callback function."""
    if isinstance(value, Function):
        return _describe_function(value)
    if isinstance(value, Bound):
        return _describe_function(value.function)
    if isinstance(value, Partial):
        return describe(value.function, place)
    if isinstance(value, Instance) and isinstance(value.cls, Class):
        method = value.cls.slots.get('__call__')
        if isinstance(method, Function):
            facts = _describe_function(method)
            return FunctionFacts(value.class_name, facts.function, facts.defined, facts.coroutine)
    if isinstance(value, (Native, Library)):
        return FunctionFacts(value.name.rpartition('.')[2], value.name)
    if isinstance(value, Class):
        return FunctionFacts(value.name, f'{value.module.name}.{value.qualname}', value.place)
    return _describe_unknown(value, place)


def _describe_function(function: Function) -> FunctionFacts:
    wrapped = function.slots.get('__wrapped__')
    if isinstance(wrapped, (Function, Bound)):
        return describe(wrapped, function.place)
    label = function.name
    if isinstance(function.node, ast.Lambda):
        label = f'lambda_{called}' if (called := _called_name(function.node)) else 'lambda'
    return FunctionFacts(label, function.full_name, function.place, function.is_coroutine)


def _called_name(node: ast.Lambda) -> str:
    body = node.body
    for part in ast.walk(body):
        if isinstance(part, ast.Call):
            if isinstance(part.func, ast.Attribute):
                return part.func.attr
            if isinstance(part.func, ast.Name):
                return part.func.id
    return ''


def _describe_unknown(value: Value | None, place: Place) -> FunctionFacts:
    if value is None or value == NONE:
        return FunctionFacts('callback', None, None, False, Unknown('no callback is given', place))
    if isinstance(value, Choice):
        return _describe_choice(value, place)
    if isinstance(value, Mystery):
        text = value.text or 'callback'
        label = re.split(r'[(\[]', text)[0].rpartition('.')[2]
        reason = Unknown(f'{text}: {value.unknown.reason}', value.unknown.at or place)
        return FunctionFacts(label or 'callback', None, None, False, reason)
    return FunctionFacts('callback', None, None, False, Unknown('not a function', place))


def _describe_choice(value: Choice, place: Place) -> FunctionFacts:
    """Objects of one class that several branches make have one function for each method."""
    options = list(dict.fromkeys(describe(option, place) for option in options_of(value)))
    if len(options) == 1 and options[0].defined is not None:
        return options[0]
    labels = list(dict.fromkeys(facts.label for facts in options))
    names = labels
    if len(labels) < len(options):
        names = [facts.function or facts.label for facts in options]
    reason = Unknown(f'one of {", ".join(names)}, depending on a branch', place)
    return FunctionFacts('_or_'.join(labels[:3]), None, None, False, reason)


def snake_case(name: str) -> str:
    """``JointStatePublisher`` -> ``joint_state_publisher``."""
    return re.sub(r'(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])', '_', name).lower()


def constant_text(value: Value | None) -> str | None:
    """A string constant's text."""
    if isinstance(value, Const) and isinstance(value.value, str):
        return value.value
    return None
