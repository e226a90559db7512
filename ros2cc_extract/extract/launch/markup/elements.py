"""
XML and YAML launch files as elements with attributes and children, each with its line.

Documents that define entities are refused: nothing here expands any.
"""

from __future__ import annotations

from dataclasses import field
from xml.parsers import expat

import yaml

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.yaml.bounds import UnboundedYamlError, composed_alone

_DEEPEST = 60
_TEXT = 'tag:yaml.org,2002:str'


@dataclass
class Element:
    """
    One element: its name, its attributes as texts, and what stands below it.

    :param lists: of a YAML file: the attributes that are lists, item by item.
    :param texts: of a YAML file: the attributes that YAML takes for texts, as all in quotes.
    """

    name: str
    place: Place
    attributes: dict[str, str] = field(default_factory=dict)
    lists: dict[str, list[str]] = field(default_factory=dict)
    texts: set[str] = field(default_factory=set)
    children: list[Element] = field(default_factory=list)

    def all(self, *names: str) -> list[Element]:
        """The children of one of these names."""
        return [child for child in self.children if child.name in names]


def read_xml(data: bytes, shown: str) -> Element | Unknown:
    """The root of an XML file."""
    parser = expat.ParserCreate()
    open_elements: list[Element] = []
    roots: list[Element] = []

    def begin(name: str, attributes: dict[str, str]) -> None:
        place = Place(shown, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1)
        element = Element(name, place, dict(attributes))
        (open_elements[-1].children if open_elements else roots).append(element)
        open_elements.append(element)
        if len(open_elements) > _DEEPEST:
            raise ValueError('it is nested too deeply')

    def end(_name: str) -> None:
        open_elements.pop()

    def refuse(*_arguments: object) -> None:
        raise ValueError('it has a document type')

    parser.StartElementHandler = begin
    parser.EndElementHandler = end
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        return Unknown('it is no XML', Place(shown, error.lineno, error.offset + 1))
    except ValueError as error:
        return Unknown(str(error), Place(shown, 1, 1))
    return roots[0] if roots else Unknown('it is empty', Place(shown, 1, 1))


def read_yaml(data: bytes, shown: str) -> Element | Unknown:
    """The root of a YAML file: ``launch`` with a list of one-key mappings."""
    try:
        root = composed_alone(data.decode(errors='replace'))
    except UnboundedYamlError as error:
        return Unknown(error.problem, Place(shown, error.mark.line + 1 if error.mark else 1, 1))
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        mark = getattr(error, 'problem_mark', None)
        line = mark.line + 1 if mark is not None else 1
        return Unknown('it is no YAML', Place(shown, line, 1))
    if not isinstance(root, yaml.MappingNode) or len(root.value) != 1:
        return Unknown('its root is no single key', Place(shown, 1, 1))
    key, value = root.value[0]
    return _element(str(key.value), value, key, shown, 0)


def _element(name: str, node: yaml.Node, key: yaml.Node, shown: str, depth: int) -> Element:
    place = Place(shown, key.start_mark.line + 1, key.start_mark.column + 1)
    element = Element(name, place)
    if depth > _DEEPEST:
        return element
    if isinstance(node, yaml.SequenceNode):
        element.children += _listed(node, shown, depth)
    elif isinstance(node, yaml.MappingNode):
        for inner, value in node.value:
            _add(element, str(inner.value), inner, value, shown, depth)
    elif isinstance(node, yaml.ScalarNode):
        element.attributes['value'] = str(node.value)
    return element


def _add(
    element: Element, name: str, key: yaml.Node, value: yaml.Node, shown: str, depth: int
) -> None:
    """One key of a mapping: an attribute, children, or several children of one name."""
    if isinstance(value, yaml.ScalarNode):
        element.attributes[name] = str(value.value)
        if value.tag == _TEXT:
            element.texts.add(name)
    elif name == 'children' and isinstance(value, yaml.SequenceNode):
        element.children += _listed(value, shown, depth)
    elif isinstance(value, yaml.SequenceNode) and all(
        isinstance(each, yaml.ScalarNode) for each in value.value
    ):
        element.lists[name] = [str(each.value) for each in value.value]
        element.attributes[name] = ' '.join(element.lists[name])
        if all(each.tag == _TEXT for each in value.value):
            element.texts.add(name)
    elif isinstance(value, yaml.SequenceNode):
        for each in value.value:
            element.children.append(_element(name, each, each, shown, depth + 1))
    else:
        element.children.append(_element(name, value, key, shown, depth + 1))


def _listed(node: yaml.SequenceNode, shown: str, depth: int) -> list[Element]:
    return [
        _element(str(key.value), value, key, shown, depth + 1)
        for each in node.value
        if isinstance(each, yaml.MappingNode)
        for key, value in each.value
    ]
