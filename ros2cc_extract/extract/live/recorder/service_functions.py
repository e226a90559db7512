"""
Functions of the program that rclpy's own services call: transitions and parameter callbacks.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. Sources: rclpy 3.3.21, 7.1.6 and 9.1.2, ``node.py`` (three lists of functions; 3.3 has
the second alone), ``lifecycle/node.py`` (``_callbacks``, by the number of the state).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from .frames import FunctionName, name_function

_PARAMETER_LISTS = (
    '_pre_set_parameters_callbacks',
    '_on_set_parameters_callbacks',
    '_post_set_parameters_callbacks',
)
_PARAMETER_SERVICE = '_set_parameters_callback'


@dataclass(frozen=True)
class Called:
    """
    One such function.

    :param kind: of the service that calls it.
    :param group: the callback group of that service.
    """

    kind: str
    function: FunctionName
    group: Any


def called_functions(node: Any) -> Iterator[Called]:
    """Give what the services of ``node`` call, as far as it has such services."""
    for service in list(node.services):
        name = getattr(service.callback, '__name__', '')
        if service is getattr(node, '_service_change_state', None):
            functions, kind = _transitions(node), 'lifecycle_service'
        elif name == _PARAMETER_SERVICE and _is_of_rclpy(name_function(service.callback)):
            functions, kind = _parameter_callbacks(node), 'parameter_service'
        else:
            continue
        for function in functions:
            yield Called(kind, function, service.callback_group)


def _transitions(node: Any) -> Iterator[FunctionName]:
    registered = getattr(node, '_callbacks', None)
    if isinstance(registered, dict):
        yield from _of_program(list(registered.values()))


def _parameter_callbacks(node: Any) -> Iterator[FunctionName]:
    found: list[Any] = []
    for name in _PARAMETER_LISTS:
        found += reversed(list(getattr(node, name, ())))
    yield from _of_program(found)


def _of_program(functions: list[Any]) -> Iterator[FunctionName]:
    """rclpy registers functions of its own as well: the default transitions, the time source."""
    for name in dict.fromkeys(map(name_function, functions)):
        if name is not None and not _is_of_rclpy(name):
            yield name


def _is_of_rclpy(function: FunctionName | None) -> bool:
    return function is not None and function.module.partition('.')[0] == 'rclpy'
