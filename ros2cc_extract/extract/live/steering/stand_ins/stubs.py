"""
Stand-ins for modules that are not installed, such as the driver of a device.

A stand-in has every name; what is called gives another one, and nothing happens. Whatever the
program makes of it, nobody has shown that it does so with the device. Interfaces that are not
installed become types that rclpy takes (``stub_interfaces.py``).

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import importlib.abc
import importlib.machinery
import json
import os
import sys
import time
from collections.abc import Iterator, Sequence
from types import ModuleType
from typing import Any

from .stub_interfaces import holds_interfaces, stand_in

# A JSON list of what the program compares texts with.
TEXTS_VARIABLE = 'ROS2CC_LIVE_STUB_TEXTS'
# Longer than most callbacks run, so that one call sees one text.
TURN_S = 0.25

# These are asked for where they may well be missing.
_NEVER = ('rclpy', 'sitecustomize', 'usercustomize', '_ros2cc_live', 'ros2cc_extract')


def offer_stubs() -> None:
    """Find a stand-in for what nobody else finds."""
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
        return _Module(spec.name)

    def exec_module(self, module: ModuleType) -> None:
        pass


class _Module(ModuleType):
    def __getattr__(self, name: str) -> Any:
        if name.startswith('__'):
            raise AttributeError(name)
        found = stand_in(self.__name__, name, _Field) or type(name, (_Stub,), {})
        setattr(self, name, found)
        return found


class _Stub(float):
    """Zero where a number is wanted, and empty where a collection is."""

    def __new__(cls, *_: Any, **__: Any) -> _Stub:
        return super().__new__(cls, 0.0)

    def __init__(self, *_: Any, **__: Any) -> None:
        pass

    def __getattr__(self, name: str) -> Any:
        if name.startswith('__'):
            raise AttributeError(name)
        return _Stub()

    def __call__(self, *_: Any, **__: Any) -> Any:
        return _Stub()

    def __iter__(self) -> Iterator[Any]:
        return iter(())

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


class _Field(_Stub):
    """
    A field of a message: as a message that nobody has filled has it, or a text of the program.

    It is equal to one of the texts that the program compares with, to each by turns: a callback
    that is called again and again takes each of its branches.
    """

    def __getattr__(self, name: str) -> Any:
        super().__getattr__(name)
        return _Field()

    def __call__(self, *_: Any, **__: Any) -> Any:
        return _Field()

    def __bool__(self) -> bool:
        return False

    def __eq__(self, other: object) -> bool:
        return other == _text_of_now() if isinstance(other, str) else super().__eq__(other)

    __hash__ = float.__hash__

    def __str__(self) -> str:
        return _text_of_now()


def _text_of_now() -> str:
    texts = ['', *json.loads(os.environ.get(TEXTS_VARIABLE, '[]'))]
    return str(texts[int(time.monotonic() / TURN_S) % len(texts)])
