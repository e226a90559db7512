"""
Parameters of YAML files: which nodes they are for, and their values.

Source: rcl_yaml_param_parser (Jazzy): nodes by name, below namespaces or with them in the key,
``ros__parameters`` below; nested keys are joined by dots; ``/**`` and ``/*`` stand for any; a
value without quotes is a bool, a number or a text by rules of its own (``parse.c``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import yaml

from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.system.launched import SetParameter
from ros2cc_extract.spec.yaml.bounds import LOADER, UnboundedYamlError, check, composed_alone

_PARAMETERS = 'ros__parameters'
_DEEPEST = 20
_SCALARS = (bool, int, float, str, type(None))
_TEXT = 'tag:yaml.org,2002:str'
_TRUE = frozenset(['Y', 'y', 'yes', 'Yes', 'YES', 'true', 'True', 'TRUE', 'on', 'On', 'ON'])
_FALSE = frozenset(['N', 'n', 'no', 'No', 'NO', 'false', 'False', 'FALSE', 'off', 'Off', 'OFF'])
_INTEGER = re.compile(r'[+-]?(0x[0-9a-f]+|0[0-7]*|[1-9][0-9]*)', re.IGNORECASE)
_DOUBLE = re.compile(r'[+-]?((\d+\.?\d*|\.\d+)(e[+-]?\d+)?|\.?inf|infinity|\.?nan)', re.IGNORECASE)
_SPECIAL = re.compile(r'\.(inf|nan)', re.IGNORECASE)
_QUOTES = ('"', "'")
_FIRST_TOO_LARGE = 2**63


def parameters_in(text: str, shown: str) -> tuple[SetParameter, ...] | Unknown:
    """The parameters that a file sets."""
    try:
        root = composed_alone(text)
    except UnboundedYamlError as error:
        return Unknown(f'parameter file: {error.problem}', Place(shown))
    except (yaml.YAMLError, RecursionError, ValueError):
        return Unknown('parameter file is no YAML', Place(shown))
    return tuple(_of_nodes(root, '', shown, 0))


def read_value(text: str) -> object:
    """A value as YAML reads it; the text itself where that fails, or gives what ROS has not."""
    try:
        check(text)
        value = yaml.load(text, Loader=LOADER)
    except (yaml.YAMLError, UnboundedYamlError, RecursionError, ValueError):
        return text
    each = value if isinstance(value, list) else [value]
    return value if all(isinstance(one, _SCALARS) for one in each) else text


def _of_nodes(
    node: yaml.Node | None, prefix: str, shown: str, depth: int
) -> Iterator[SetParameter]:
    if not isinstance(node, yaml.MappingNode) or depth > _DEEPEST:
        return
    for key, value in node.value:
        name = str(key.value)
        if name == _PARAMETERS:
            yield from _values(value, '', prefix or '/**', shown, depth)
        else:
            yield from _of_nodes(value, f'{prefix}/{name.strip("/")}', shown, depth + 1)


def _values(
    node: yaml.Node, prefix: str, of_node: str, shown: str, depth: int
) -> Iterator[SetParameter]:
    if not isinstance(node, yaml.MappingNode) or depth > _DEEPEST:
        return
    for key, value in node.value:
        name = f'{prefix}{key.value}'
        if isinstance(value, yaml.MappingNode):
            yield from _values(value, f'{name}.', of_node, shown, depth + 1)
        else:
            place = Place(shown, key.start_mark.line + 1, key.start_mark.column + 1)
            yield SetParameter(name=name, value=_plain(value), node=of_node, source=place)


def _plain(node: yaml.Node) -> object:
    if isinstance(node, yaml.SequenceNode):
        return tuple(_plain(each) for each in node.value)
    text = str(node.value)
    is_quoted = isinstance(node, yaml.ScalarNode) and node.style in _QUOTES
    return text if is_quoted else _of_rcl(text, node.tag)


def _of_rcl(text: str, tag: str) -> object:
    """What stands without quotes, as rcl reads it, which has no ``null``; some have ``!!str``."""
    if tag == _TEXT and not isinstance(read_value(text), str):
        return text
    if text in _TRUE or text in _FALSE:
        return text in _TRUE
    if _INTEGER.fullmatch(text) and abs(number := _integer(text)) < _FIRST_TOO_LARGE:
        return number
    if _DOUBLE.fullmatch(text):
        return float(_SPECIAL.sub(r'\1', text))
    return text or None


def _integer(text: str) -> int:
    digits = text.lstrip('+-').lower()
    base = 16 if digits.startswith('0x') else 8 if digits.startswith('0') else 10
    return int(digits, base) * (-1 if text.startswith('-') else 1)
