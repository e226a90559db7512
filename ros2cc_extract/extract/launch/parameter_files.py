"""
Parameters of YAML files: which nodes they are for, and their values.

Source: rcl_yaml_param_parser (Jazzy): nodes by name, below namespaces or with them in the key,
``ros__parameters`` below; nested keys are joined by dots; ``/**`` and ``/*`` stand for any.
"""

from __future__ import annotations

from collections.abc import Iterator

import yaml

from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.system.launched import SetParameter
from ros2cc_extract.spec.yaml.bounds import LOADER, UnboundedYamlError, check, composed_alone

_PARAMETERS = 'ros__parameters'
_DEEPEST = 20
_SCALARS = (bool, int, float, str, type(None))


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
    if node.tag == 'tag:yaml.org,2002:str':
        return str(node.value)
    return read_value(str(node.value))
