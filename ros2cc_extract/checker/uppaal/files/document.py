"""
The XML of a UPPAAL model as a tree of texts with true line numbers.

Owns reading the file and nothing of the language inside the texts. Never expands entities and
never recurses over the input, so that a hostile file costs memory in proportion to its size.
Element names: UPPAAL documentation, page "XML file format" (flat-1_x DTD).
"""

from __future__ import annotations

import re
from dataclasses import field
from xml.parsers import expat

from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

MAX_DEPTH = 64
_MEND_XML = 'save the model again from UPPAAL or give a .xml file that UPPAAL opens'
_MEND_TEXTUAL = 'the textual formats .xta and .ta are not read; save it as .xml from UPPAAL'
_TEXTUAL = re.compile(rb'\s*(//|/\*|process\b|system\b|(const|clock|int|chan|typedef)\s)')


@dataclass(frozen=True)
class Text:
    """A piece of model text and the line of the XML file on which it starts."""

    value: str
    line: int


@dataclass(frozen=True)
class LocationNode:
    """A location as written; ``id`` is the XML reference, ``name`` may be empty."""

    id: str
    name: str
    urgent: bool
    committed: bool
    line: int


@dataclass(frozen=True)
class EdgeNode:
    """An edge as written; labels by kind, absent kinds are absent keys."""

    source: str
    target: str
    labels: dict[str, Text]
    line: int


@dataclass(frozen=True)
class TemplateNode:
    """A template as written."""

    name: Text
    parameters: Text
    declarations: Text
    locations: tuple[LocationNode, ...]
    initial: str
    edges: tuple[EdgeNode, ...]


@dataclass(frozen=True)
class QueryNode:
    """A query stored in the model."""

    formula: Text
    comment: str


@dataclass(frozen=True)
class Document:
    """
    One model file.

    :param instantiation: what files of before UPPAAL 4 keep apart from the system line.
    """

    file: str
    declarations: Text
    templates: tuple[TemplateNode, ...]
    instantiation: Text
    system: Text
    queries: tuple[QueryNode, ...]


@dataclass
class _Element:
    tag: str
    attributes: dict[str, str]
    line: int
    pieces: list[str] = field(default_factory=list)
    text_line: int = 0
    children: list[_Element] = field(default_factory=list)

    def text(self) -> Text:
        return Text(''.join(self.pieces), self.text_line or self.line)

    def all(self, tag: str) -> list[_Element]:
        return [child for child in self.children if child.tag == tag]

    def first_text(self, tag: str) -> Text:
        found = self.all(tag)
        return found[0].text() if found else Text('', self.line)


def _is_textual(data: bytes) -> bool:
    return _TEXTUAL.match(data) is not None


class _TreeReader:
    """Builds elements from expat's events, without recursion."""

    def __init__(self, file: str, encoding: str | None) -> None:
        self._file = file
        self._parser = expat.ParserCreate(encoding)
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._characters
        self._parser.EntityDeclHandler = self._entity
        self._open: list[_Element] = []
        self._root: _Element | None = None

    def read(self, data: bytes) -> _Element:
        try:
            self._parser.Parse(data, True)
        except expat.ExpatError as error:
            what = f'not well-formed XML: {expat.ErrorString(error.code)}'
            mend = _MEND_TEXTUAL if _is_textual(data) else _MEND_XML
            raise ModelFormatError(what, Place(self._file, error.lineno), mend) from None
        except (LookupError, ValueError) as error:
            raise ModelFormatError(
                f'not readable as XML: {error}', Place(self._file), _MEND_XML
            ) from None
        assert self._root is not None
        return self._root

    def _here(self) -> Place:
        return Place(self._file, self._parser.CurrentLineNumber)

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        if len(self._open) >= MAX_DEPTH:
            raise ModelFormatError(
                f'XML elements nest deeper than {MAX_DEPTH}', self._here(), _MEND_XML
            )
        element = _Element(tag, attributes, self._parser.CurrentLineNumber)
        if self._open:
            self._open[-1].children.append(element)
        else:
            self._root = element
        self._open.append(element)

    def _end(self, tag: str) -> None:
        self._open.pop()

    def _characters(self, data: str) -> None:
        if self._open:
            element = self._open[-1]
            if not element.pieces:
                element.text_line = self._parser.CurrentLineNumber
            element.pieces.append(data)

    def _entity(self, name: str, *_rest: object) -> None:
        raise ModelFormatError(
            f'the document declares the entity {name!r}',
            self._here(),
            'entities are not expanded; write the text itself',
        )


def read_document(data: bytes, file: str, encoding: str | None = None) -> Document:
    """
    Read one model file.

    :param encoding: overrides what the XML declaration says; None to believe it.
    :raises ModelFormatError: no XML, no UPPAAL model, or an element outside the subset.
    """
    if not data.strip():
        raise ModelFormatError('the file is empty', Place(file), _MEND_XML)
    if b'\0' in data[:4096] and not data.startswith((b'\xff\xfe', b'\xfe\xff')):
        raise ModelFormatError('the file is binary, not XML', Place(file), _MEND_XML)
    root = _TreeReader(file, encoding).read(data)
    if root.tag != 'nta':
        raise ModelFormatError(
            f'not a UPPAAL model: the root element is <{root.tag}>, not <nta>',
            Place(file, root.line),
            _MEND_XML,
        )
    _refuse(root, file, 'imports', 'lsc', 'dynamic')
    if not root.all('system'):
        raise ModelFormatError(
            'the model has no <system>', Place(file, root.line), 'add the system declaration'
        )
    return Document(
        file=file,
        declarations=root.first_text('declaration'),
        templates=tuple(_template(node, file) for node in root.all('template')),
        instantiation=root.first_text('instantiation'),
        system=root.first_text('system'),
        queries=_queries(root),
    )


def _refuse(element: _Element, file: str, *tags: str) -> None:
    for child in element.children:
        if child.tag in tags and (child.children or child.text().value.strip()):
            raise ModelFormatError(
                f'<{child.tag}> is outside the supported subset of UPPAAL',
                Place(file, child.line),
                'remove it; docs/checker.md lists the subset',
            )


def _template(node: _Element, file: str) -> TemplateNode:
    _refuse(node, file, 'instance', 'message', 'condition', 'update', 'yloccoord')
    for branch in node.all('branchpoint'):
        raise ModelFormatError(
            'branch points are outside the supported subset of UPPAAL',
            Place(file, branch.line),
            'draw one edge for each branch',
        )
    inits = node.all('init')
    if not inits:
        raise ModelFormatError(
            f'template {node.first_text("name").value!r} has no initial location',
            Place(file, node.line),
            'mark one location as initial',
        )
    return TemplateNode(
        name=node.first_text('name'),
        parameters=node.first_text('parameter'),
        declarations=node.first_text('declaration'),
        locations=tuple(_location(child, file) for child in node.all('location')),
        initial=_attribute(inits[0], 'ref', file),
        edges=tuple(_edge(child, file) for child in node.all('transition')),
    )


def _attribute(node: _Element, name: str, file: str) -> str:
    if name not in node.attributes:
        raise ModelFormatError(
            f'<{node.tag}> lacks the attribute {name!r}', Place(file, node.line), _MEND_XML
        )
    return node.attributes[name]


def _location(node: _Element, file: str) -> LocationNode:
    for label in node.all('label'):
        kind = label.attributes.get('kind', '')
        text = label.text()
        if kind in ('comments', 'testcodeEnter', 'testcodeExit') or not text.value.strip():
            continue
        if kind == 'invariant' and text.value.strip() == 'true':
            continue
        raise ModelFormatError(
            f'a location label of kind {kind!r} is outside the supported subset of UPPAAL',
            Place(file, text.line),
            'invariants and rates need clocks; put the condition into the guards',
        )
    return LocationNode(
        id=_attribute(node, 'id', file),
        name=node.first_text('name').value.strip(),
        urgent=bool(node.all('urgent')),
        committed=bool(node.all('committed')),
        line=node.line,
    )


_EDGE_LABELS = {'select', 'guard', 'synchronisation', 'assignment', 'comments'}


def _edge(node: _Element, file: str) -> EdgeNode:
    labels: dict[str, Text] = {}
    for label in node.all('label'):
        kind = label.attributes.get('kind', '')
        text = label.text()
        if kind == 'testcode' or not text.value.strip():
            continue
        if kind not in _EDGE_LABELS:
            raise ModelFormatError(
                f'an edge label of kind {kind!r} is outside the supported subset of UPPAAL',
                Place(file, text.line),
                'keep select, guard, synchronisation, assignment and comments',
            )
        labels[kind] = text
    if 'comments' not in labels and node.first_text('comments').value.strip():
        labels['comments'] = node.first_text('comments')
    if node.attributes.get('controllable') == 'false':
        raise ModelFormatError(
            'uncontrollable edges are outside the supported subset of UPPAAL',
            Place(file, node.line),
            'games are not checked; make the edge controllable',
        )
    return EdgeNode(
        source=_end_of(node, 'source', file),
        target=_end_of(node, 'target', file),
        labels=labels,
        line=node.line,
    )


def _end_of(node: _Element, tag: str, file: str) -> str:
    ends = node.all(tag)
    if not ends:
        raise ModelFormatError(
            f'an edge has no <{tag}>', Place(file, node.line), 'connect both ends of the edge'
        )
    return _attribute(ends[0], 'ref', file)


def _queries(root: _Element) -> tuple[QueryNode, ...]:
    nodes = [query for group in root.all('queries') for query in group.all('query')]
    return tuple(
        QueryNode(query.first_text('formula'), query.first_text('comment').value.strip())
        for query in nodes
        if query.first_text('formula').value.strip()
    )
