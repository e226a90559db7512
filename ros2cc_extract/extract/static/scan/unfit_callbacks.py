"""
Callbacks that do not take what rclpy passes: each call raises ``TypeError``, and nothing runs.

Sources: rclpy 7.1.6 and 9.1.2, ``executors.py`` (``_execute_service`` …); 7.1.6,
``subscription.py`` (a second parameter gets the information of the message); 9.1.2,
``executors.py`` (``_take_timer``: a parameter annotated as ``TimerInfo`` gets the times of the
call; 7.1.6 passes nothing).
"""

from __future__ import annotations

import ast
from dataclasses import replace

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState
from ros2cc_extract.extract.static.python.values.argument_binding import fits
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Function,
    Partial,
    Value,
)
from ros2cc_extract.extract.static.scan.ros_interpreter import RosInterpreter
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import EntityKind

_PASSED = {
    EntityKind.TIMER: (0, 1),
    EntityKind.SUBSCRIPTION: (1, 2),
    EntityKind.SERVICE: (2,),
    EntityKind.ACTION_EXECUTE: (1,),
    EntityKind.DONE_CALLBACK: (1,),
}


def is_unfit(machine: RosInterpreter, entity: EntityState, callback: Value) -> bool:
    """Whether an entity can never call that function; if so, report it."""
    numbers = _PASSED.get(entity.kind)
    function, bound = _called(callback, entity.place)
    if numbers is None or entity.library is not None or not isinstance(function, Function):
        return False
    calls = {each: replace(bound, args=[*bound.args, *[NONE] * each]) for each in numbers}
    fitting = [each for each, call in calls.items() if fits(function, call)]
    if not fitting or (entity.kind is EntityKind.TIMER and fitting == [1] and not _asks(function)):
        _report(machine, function, numbers[0])
        return True
    entity.takes_info = entity.takes_info or numbers[0] not in fitting
    return False


def _called(callback: Value, at: Place) -> tuple[Value, Call]:
    """What is called in the end, and what it gets before that which rclpy passes."""
    if isinstance(callback, Partial):
        function, bound = _called(callback.function, at)
        bound.args.extend(callback.args)
        bound.keywords.update(callback.keywords)
        bound.more = bound.more or callback.more
        return function, bound
    if isinstance(callback, Bound):
        return callback.function, Call(at, [callback.receiver])
    return callback, Call(at)


def _asks(function: Function) -> bool:
    """Whether a timer's function asks for the times of the call, by the type of a parameter."""
    arguments = function.node.args
    return any(
        parameter.annotation is not None
        and ast.unparse(parameter.annotation).strip('\'"').rpartition('.')[2] == 'TimerInfo'
        for parameter in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)
    )


def _report(machine: RosInterpreter, function: Function, number: int) -> None:
    many = '1 argument' if number == 1 else f'{number} arguments'
    name = 'this lambda' if isinstance(function.node, ast.Lambda) else function.name
    at = Place(function.module.file, function.node.lineno, function.node.col_offset + 1)
    reported = Diagnostic(
        severity=Severity.WARNING,
        slug='not-followed',
        place=at,
        message=f'{name} does not take the {many} that rclpy passes to it: each call raises '
        'TypeError, so what it does is not looked at',
        help='give it the parameters of such a callback',
    )
    if reported not in machine.world.diagnostics:
        machine.world.diagnostics.append(reported)
