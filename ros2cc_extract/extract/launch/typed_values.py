"""
Parameters of launch files that are given a type.

Source: launch (Jazzy) ``utilities/type_utils.py`` (``coerce_to_type``); launch_ros (Jazzy)
``parameter_descriptions.py``.
"""

from __future__ import annotations

from collections.abc import Callable

from ros2cc_extract.extract.launch.language.actions import LIST_OF
from ros2cc_extract.extract.launch.parameter_files import read_value
from ros2cc_extract.source_locations import Unknown

_NUMBERS: dict[str, Callable[[str], object]] = {'int': int, 'float': float}
_READ: dict[str, type] = {'bool': bool, **{f'{LIST_OF}{name}': tuple for name in (
    'int', 'float', 'bool', 'str')}}  # fmt: skip


def typed(text: str, kind: str) -> object:
    """What a text is as a value of ``kind``, or by the rules of YAML where that is empty."""
    if kind == 'str':
        return text
    if kind in _NUMBERS:
        try:
            return _NUMBERS[kind](text)
        except ValueError:
            return Unknown(f'it is no {kind}')
    value = read_value(text)
    found = tuple(value) if isinstance(value, list) else value
    if not kind or isinstance(found, _READ.get(kind, ())):
        return found
    return Unknown(f'it is no {kind}')
