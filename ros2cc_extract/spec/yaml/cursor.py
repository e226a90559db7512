"""A YAML node together with its place, so that every complaint names file and line."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from enum import Enum
from typing import TypeVar

import yaml

from ros2cc_extract.errors import SpecFormatError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.yaml.bounds import TOO_DEEP, UnboundedYamlError, composed

_TAG = 'tag:yaml.org,2002:'
_KINDS = {
    'map': 'a mapping',
    'seq': 'a list',
    'str': 'a text',
    'int': 'a number',
    'float': 'a number',
    'bool': 'true or false',
    'null': 'nothing',
}

E = TypeVar('E', bound=Enum)


@dataclass(frozen=True)
class Cursor:
    """
    One node of a YAML document.

    :param node: as composed by PyYAML; anchors are resolved, values are not built.
    :param path: how to call the node in a message, such as ``callbacks[2].type``.
    """

    node: yaml.Node
    file: str
    path: str = ''

    @property
    def place(self) -> Place:
        """Line and column where the node starts."""
        mark = self.node.start_mark
        return Place(self.file, mark.line + 1, mark.column + 1)

    @property
    def kind(self) -> str:
        """The YAML type without its prefix: ``str``, ``int``, ``map`` …"""
        return str(self.node.tag).removeprefix(_TAG)

    @property
    def is_null(self) -> bool:
        """True for an empty value."""
        return self.kind == 'null'

    def error(self, what: str, mend: str = '') -> SpecFormatError:
        """Make the complaint about this node; the caller raises it."""
        return SpecFormatError(what, self.place, mend)

    def mapping(self, known: Collection[str], required: Collection[str] = ()) -> dict[str, Cursor]:
        """
        Read a mapping of known keys.

        :raises SpecFormatError: if it is no mapping, or has an unknown, repeated or missing key.
        """
        if not isinstance(self.node, yaml.MappingNode):
            raise self._mismatch('a mapping')
        found: dict[str, Cursor] = {}
        for key_node, value_node in self.node.value:
            key = Cursor(key_node, self.file, self.path)
            name = key.text()
            if name in found:
                raise key.error(f'key {name!r} stands twice{self._within()}', 'keep one')
            if name not in known:
                raise key.error(
                    f'unknown key {name!r}{self._within()}', f'known keys: {", ".join(known)}'
                )
            found[name] = Cursor(value_node, self.file, f'{self.path}.{name}'.lstrip('.'))
        missing = [name for name in required if name not in found]
        if missing:
            raise self.error(f'key {missing[0]!r} is missing{self._within()}', 'add it')
        return found

    def items(self, *, at_least: int = 0) -> Iterator[Cursor]:
        """
        Read a list.

        :raises SpecFormatError: if it is no list, or shorter than ``at_least``.
        """
        if not isinstance(self.node, yaml.SequenceNode):
            raise self._mismatch('a list')
        if len(self.node.value) < at_least:
            raise self.error(f'{self.path!r} is empty', 'at least one entry is needed')
        for index, child in enumerate(self.node.value):
            yield Cursor(child, self.file, f'{self.path}[{index}]')

    def text(self) -> str:
        """Read a text; ``on``, ``12`` and the like are no texts unless quoted."""
        if self.kind != 'str':
            mend = 'put it in quotes' if isinstance(self.node, yaml.ScalarNode) else ''
            raise self._mismatch('a text', mend)
        return str(self.node.value)

    def flag(self) -> bool:
        """Read ``true`` or ``false``."""
        return bool(self._scalar('bool', 'true or false'))

    def count(self) -> int:
        """Read a number of things, 0 or more."""
        value = self._scalar('int', 'a whole number')
        if not isinstance(value, int) or value < 0:
            raise self.error(f'{self.path!r} is {value}', 'it must be 0 or more')
        return value

    def number(self) -> float:
        """Read a number of seconds."""
        if self.kind not in ('int', 'float'):
            raise self._mismatch('a number')
        return float(self._scalar(self.kind, 'a number'))  # type: ignore[arg-type]

    def member(self, choices: type[E]) -> E:
        """Read one of the values of an enumeration."""
        value = self.text()
        for choice in choices:
            if choice.value == value:
                return choice
        listing = ', '.join(str(choice.value) for choice in choices)
        raise self.error(f'{self.path!r} is {value!r}', f'write one of {listing}')

    def _scalar(self, kind: str, wanted: str) -> object:
        if self.kind != kind:
            raise self._mismatch(wanted)
        loader = yaml.SafeLoader('')
        try:
            return loader.construct_object(self.node)
        except (ValueError, yaml.YAMLError):
            raise self._mismatch(wanted) from None
        finally:
            loader.dispose()

    def _mismatch(self, wanted: str, mend: str = '') -> SpecFormatError:
        subject = repr(self.path) if self.path else 'the document'
        found = _KINDS.get(self.kind, f'of type {self.kind}')
        return self.error(f'{subject} must be {wanted}, it is {found}', mend)

    def _within(self) -> str:
        return f' in {self.path!r}' if self.path else ''


def compose(text: str, file: str) -> Iterator[Cursor]:
    """
    Parse a YAML stream into the roots of its documents.

    :raises SpecFormatError: when the text is no YAML.
    """
    try:
        for root in composed(text):
            if root is not None:
                yield Cursor(root, file)
    except UnboundedYamlError as error:
        raise SpecFormatError(error.problem, _place_of(error.mark, file), _NO_YAML) from None
    except yaml.MarkedYAMLError as error:
        raise SpecFormatError(_problem(error), _error_place(error, file), _NO_YAML) from None
    except yaml.YAMLError as error:
        raise SpecFormatError(str(error).splitlines()[0], Place(file), _NO_YAML) from None


_NO_YAML = 'a specification is a YAML mapping with the key node'


def _problem(error: yaml.MarkedYAMLError) -> str:
    if 'nesting depth' in (error.problem or ''):
        return TOO_DEEP
    return f'no valid YAML: {error.problem or error.context or "cannot be parsed"}'


def _error_place(error: yaml.MarkedYAMLError, file: str) -> Place:
    return _place_of(error.problem_mark or error.context_mark, file)


def _place_of(mark: yaml.Mark | None, file: str) -> Place:
    return Place(file, mark.line + 1, mark.column + 1) if mark else Place(file)
