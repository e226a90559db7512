"""
Stand-ins for modules that are not installed, such as the driver of a device.

A stand-in has every name; what is called gives another one, and nothing happens. Whatever the
program makes of it, nobody has shown that it does so with the device.

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import importlib.abc
import importlib.machinery
import sys
from collections.abc import Iterator, Sequence
from types import ModuleType
from typing import Any

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
        of_a_real_package = '.' in name and not isinstance(known, _Module)
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
        found = type(name, (_Stub,), {})
        setattr(self, name, found)
        return found


class _Stub:
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
