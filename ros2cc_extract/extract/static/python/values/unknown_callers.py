"""Calls by unknown code."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.values.values import (
    NO_CALLER,
    Call,
    Function,
    Mystery,
    Value,
)
from ros2cc_extract.source_locations import Place, Unknown


def unknown_arguments(function: Function, place: Place, skip: int) -> Call:
    """A call of ``function`` by unknown code."""
    arguments = function.node.args
    names = [parameter.arg for parameter in (*arguments.posonlyargs, *arguments.args)]
    defaults = dict(
        zip(names[len(names) - len(function.defaults) :], function.defaults, strict=False)
    )
    defaults.update(function.keyword_defaults)
    call = Call(place)
    for name in names[skip:]:
        call.args.append(_unknown_argument(function, name, defaults.get(name)))
    for parameter in arguments.kwonlyargs:
        name = parameter.arg
        call.keywords[name] = _unknown_argument(function, name, defaults.get(name))
    if arguments.vararg or arguments.kwarg:
        reason = f'further arguments of {function.qualname}; {NO_CALLER}'
        call.more = Unknown(reason, function.place)
    return call


def _unknown_argument(function: Function, name: str, default: Value | None) -> Mystery:
    reason = f'parameter {name!r} of {function.qualname}; {NO_CALLER}'
    return Mystery(Unknown(reason, function.place), name, default)
