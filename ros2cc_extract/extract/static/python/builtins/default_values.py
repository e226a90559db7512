"""What parameters are if nothing is passed: made once, where the function is defined."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import Function


def keep_defaults(machine: Machine, function: Function, frame: Frame) -> None:
    """Evaluate them, and know each by its parameter: all calls share it."""
    arguments = function.node.args
    function.defaults = tuple(machine.evaluate(d, frame) for d in arguments.defaults)
    parameters = (*arguments.posonlyargs, *arguments.args)
    for parameter, value in zip(reversed(parameters), reversed(function.defaults), strict=False):
        machine.name_value(value, parameter.arg)
        machine.note_held(function, parameter.arg, value)
    for parameter, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True):
        if default is not None:
            value = machine.evaluate(default, frame)
            function.keyword_defaults[parameter.arg] = value
            machine.note_held(function, parameter.arg, value)
