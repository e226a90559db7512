"""
Stand-ins for modules that are not installed, such as the driver of a device.

A stand-in has every name; what is called gives another one, and nothing happens. What the
program does with it does not show what it does with the device. Interfaces that are not
installed become types that rclpy takes (``stub_interfaces.py``), and of some modules it is known
what they do.

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import importlib
import importlib.abc
import importlib.machinery
import json
import opcode
import os
import sys
import time
from collections.abc import Iterator, Sequence
from types import ModuleType
from typing import Any

from .stub_interfaces import Constant, constants, holds_interfaces, stand_in

handed: set[str] = set()
"""Functions of the program that stand-ins were given: the module itself might call them."""
# A JSON list of the texts and the numbers that the program compares with.
VALUES_VARIABLE = 'ROS2CC_LIVE_STUB_VALUES'
# Longer than most callbacks run, so that one call sees one text.
TURN_S = 0.25

_OF_EXCEPTIONS = ('Exception', 'Error', 'Warning', 'Interrupt')
_SPREAD = opcode.opmap['UNPACK_SEQUENCE']
# What they do with the executor is known: a stand-in does the same.
_KNOWN = {
    'message_filters': 'message_filters',
    'nav2_simple_commander.robot_navigator': 'navigator',
    'tf2_ros': 'buffer_client',
    'tf2_ros.buffer_client': 'buffer_client',
}
# These are asked for where they may well be missing.
_NEVER = ('rclpy', 'sitecustomize', 'usercustomize', '_ros2cc_live', 'ros2cc_extract')


def offer_stubs() -> None:
    """Find a stand-in for what no other finder finds."""
    sys.meta_path.append(_Finder())


class _Finder:
    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: Any = None
    ) -> importlib.machinery.ModuleSpec | None:
        first = name.partition('.')[0]
        known = sys.modules.get(first)
        # The interfaces of a package are made when it is built; its own code may be here.
        of_a_real_package = (
            '.' in name and not isinstance(known, _Module) and not holds_interfaces(name)
        )
        if first in _NEVER or of_a_real_package or not _asked_by_program():
            return None
        return importlib.machinery.ModuleSpec(name, _Loader(), is_package=True)


def _asked_by_program() -> bool:
    """Whether it is not the standard library that tries what may be missing."""
    frame = sys._getframe(2)
    found: Any = frame
    while found is not None and 'importlib' in found.f_code.co_filename:
        found = found.f_back
    name = str(found.f_globals.get('__name__', '')) if found is not None else ''
    return name.partition('.')[0] not in sys.stdlib_module_names or name == '__main__'


class _Loader(importlib.abc.Loader):
    def create_module(self, spec: importlib.machinery.ModuleSpec) -> ModuleType:
        module = _Module(spec.name)
        if spec.name in _KNOWN:
            known = importlib.import_module(f'.{_KNOWN[spec.name]}', __package__)
            for name, each in vars(known).items():
                if getattr(each, '__module__', None) == known.__name__:
                    setattr(module, name, each)
        return module

    def exec_module(self, module: ModuleType) -> None:
        pass


class _Module(ModuleType):
    def __getattr__(self, name: str) -> Any:
        if name.startswith('__'):
            raise AttributeError(name)
        base = Exception if name.endswith(_OF_EXCEPTIONS) else _Stub
        found = stand_in(self.__name__, name, _Field) or type(name, (base,), {})
        setattr(self, name, found)
        return found


class _Stub(float):
    """
    Zero where a number is wanted, and empty where a collection is.

    Where it is to be spread over so many names, it has as many values.
    """

    def __new__(cls, *given: Any, **named: Any) -> _Stub:
        _note_functions(*given, *named.values())
        return super().__new__(cls, 0.0)

    def __init__(self, *_: Any, **__: Any) -> None:
        pass

    def __init_subclass__(cls) -> None:
        if cls.__module__ != __name__:
            handed.add(cls.__name__)

    def __setattr__(self, name: str, value: Any) -> None:
        _note_functions(value)
        super().__setattr__(name, value)

    def __getattr__(self, name: str) -> Any:
        if name.startswith('__'):
            raise AttributeError(name)
        return _Stub()

    def __call__(self, *given: Any, **named: Any) -> Any:
        _note_functions(*given, *named.values())
        return _Stub()

    def __iter__(self) -> Iterator[Any]:
        return iter([_Stub() for _ in range(_names_to_fill(sys._getframe(1)))])

    def __len__(self) -> int:
        return 0

    def __getitem__(self, _: Any) -> Any:
        return _Stub()

    def __bool__(self) -> bool:
        return True

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: Any) -> None:
        pass


def _note_functions(*values: Any) -> None:
    for each in values:
        if callable(each) and not isinstance(each, (type, _Stub)):
            handed.add(getattr(each, '__qualname__', type(each).__name__))


def _names_to_fill(frame: Any) -> int:
    """How many names are on the left of the ``=`` that is carried out; 0 where none is."""
    code, at = frame.f_code.co_code, frame.f_lasti
    is_spread = 0 <= at < len(code) - 1 and code[at] == _SPREAD
    return int(code[at + 1]) if is_spread else 0


class _Field(_Stub):
    """
    A field of a message: as a message has it that was not filled, or a value of the program.

    By turns it is equal to each of the texts and numbers that the program compares with, and to
    each of the constants of its type, and is true or not: a callback that is called again and
    again takes each of its branches.
    """

    def __new__(cls, *_: Any, **__: Any) -> _Field:
        return float.__new__(cls, _of_now([0, *_values(float, int), 1]))

    def __getattr__(self, name: str) -> Any:
        super().__getattr__(name)
        return _Field()

    def __call__(self, *given: Any, **named: Any) -> Any:
        super().__call__(*given, **named)
        return _Field()

    def __bool__(self) -> bool:
        return _turn() // (1 + len(_values(str))) % 2 == 1

    def __eq__(self, other: object) -> bool:
        if isinstance(other, str):
            return other == _text_of_now()
        if isinstance(other, Constant):
            return other is _of_now(constants())
        return super().__eq__(other)

    __hash__ = float.__hash__

    def __str__(self) -> str:
        return _text_of_now()


def _text_of_now() -> str:
    return str(_of_now(['', *_values(str)]))


def _values(*kinds: type) -> list[Any]:
    values = json.loads(os.environ.get(VALUES_VARIABLE, '[]'))
    return [each for each in values if isinstance(each, kinds)]


def _of_now(values: Sequence[Any]) -> Any:
    return values[_turn() % len(values)]


def _turn() -> int:
    return int(time.monotonic() / TURN_S)
