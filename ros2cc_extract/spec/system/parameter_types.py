"""
Types of parameters, of values in code and of what a launch sets.

Source: rclpy 7.1.6, ``parameter.py``; rcl (Jazzy), ``rcl_yaml_param_parser/src/parse.c``.
"""

from __future__ import annotations

import re

BYTES = 'byte array'
_ARRAY = ' array'
# What YAML 1.1 takes for a text and rcl, where it stands without quotes, for a number or a bool.
_EITHER = re.compile(
    r'[yYnN]|[+-]?(\d[\d_]*|\d*\.\d+|\d+\.\d*)[eE][+-]?\d+|[+-]?(inf\w*|nan)', re.I
)


def type_of(value: object) -> str | None:
    """The type of a value; ``None`` where it has none of its own, or rcl may see another one."""
    if isinstance(value, tuple):
        types = {type_of(each) for each in value}
        one = types.pop() if len(types) == 1 else None
        return None if one is None else one + _ARRAY
    if isinstance(value, bool):
        return 'bool'
    if isinstance(value, int):
        return 'integer'
    if isinstance(value, float):
        return 'double'
    if isinstance(value, bytes):
        return 'byte'
    return 'string' if isinstance(value, str) else None


def type_set(value: object) -> str | None:
    """The type of what a launch sets, as it reaches the node."""
    texts = value if isinstance(value, tuple) else (value,)
    if any(isinstance(text, str) and _EITHER.fullmatch(text) for text in texts):
        return None
    return type_of(value)
