"""
From the document to the network: every process with its locations and edges.

Subset and semantics: docs/checker.md. Selects are expanded here, so that an edge of the network
has fixed select values.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import field
from typing import Any

from ros2cc_extract.checker.network.arithmetic import const, truth
from ros2cc_extract.checker.network.network import (
    Call,
    Check,
    Const,
    Direction,
    Edge,
    Expr,
    Location,
    Network,
    Process,
    Property,
    QueryKind,
    Sync,
)
from ros2cc_extract.checker.network.traversal import has_effect, walk
from ros2cc_extract.checker.uppaal.elaboration.declarations import Declarations
from ros2cc_extract.checker.uppaal.elaboration.expressions import Expressions
from ros2cc_extract.checker.uppaal.elaboration.functions import FunctionCompiler
from ros2cc_extract.checker.uppaal.elaboration.instances import Definition, Instance, Instances
from ros2cc_extract.checker.uppaal.elaboration.network_tables import Tables
from ros2cc_extract.checker.uppaal.elaboration.types import (
    ChannelType,
    ProcessSymbol,
    Scope,
    ValueSymbol,
)
from ros2cc_extract.checker.uppaal.files.document import Document, EdgeNode, TemplateNode, Text
from ros2cc_extract.checker.uppaal.language import syntax
from ros2cc_extract.checker.uppaal.language.parsing import Start, parse, parse_query
from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

MAX_EDGES = 250_000


@dataclass(eq=False)
class Elaboration:
    """
    An elaborated model that can still elaborate queries and expressions.

    :param scope: names a query sees: global declarations and processes.
    """

    tables: Tables
    expressions: Expressions
    scope: Scope
    process_scopes: dict[str, Scope] = field(default_factory=dict)

    def network(self) -> Network:
        """Return the network, with all functions elaborated so far."""
        return self.tables.snapshot()

    def query(self, text: str, place: Place) -> Property:
        """Elaborate one query, whose first line is ``place``."""
        node = parse_query(text, place)
        scope = Scope(place.file, self.scope)
        operands = [
            truth(self.expressions.pure(operand, scope, 'the query')) for operand in node.operands
        ]
        if node.operator == QueryKind.LEADS_TO.value:
            return Property(QueryKind.LEADS_TO, operands[1], operands[0])
        return Property(QueryKind(node.operator), operands[0])

    def expression(self, text: str, process: str | None, place: Place) -> Expr:
        """Elaborate a state expression in the scope of a process, or the global one."""
        outer = self.process_scopes[process] if process else self.scope
        node = parse(text, Start.CONDITION, place)
        return self.expressions.pure(node, Scope(place.file, outer), 'the expression')


def elaborate(document: Document) -> Elaboration:
    """
    Elaborate a whole model.

    :raises ModelFormatError: undeclared names, wrong types or ranges, unsupported constructs.
    """
    tables = Tables()
    expressions = Expressions(tables)
    functions = FunctionCompiler(expressions)
    expressions.calls = functions
    return _ModelBuilder(document, tables, expressions).build(functions)


class _ModelBuilder:
    def __init__(self, document: Document, tables: Tables, expressions: Expressions) -> None:
        self._document = document
        self._tables = tables
        self._expressions = expressions
        self._declarations = Declarations(tables, expressions)
        self._scope = Scope(document.file)
        self._edge_count = 0
        # Texts are parsed once, however many instances a template has; keys are ids of nodes.
        self._labels: dict[int, _EdgeLabels] = {}
        self._local: dict[int, tuple[syntax.Declaration, ...]] = {}

    def build(self, functions: FunctionCompiler) -> Elaboration:
        self._declarations.declare(
            self._parsed(self._document.declarations, Start.DECLARATIONS), self._scope
        )
        instances = Instances(
            self._expressions,
            functions,
            self._scope,
            dict(self._templates()),
        )
        result = Elaboration(self._tables, self._expressions, self._scope.inner())
        for instance, line in self._system(instances):
            if instance.name in result.process_scopes:
                what = f'process {instance.name} stands twice in the system line'
                raise ModelFormatError(what, self._scope.place(line), 'remove one')
            self._process(instance, result, line)
        return result

    def _place(self, text: Text) -> Place:
        return Place(self._document.file, text.line)

    def _parsed(self, text: Text, start: Start) -> tuple[syntax.Declaration, ...]:
        return tuple(parse(text.value, start, self._place(text)))

    def _templates(self) -> Iterator[tuple[str, Definition]]:
        seen: set[str] = set()
        for node in self._document.templates:
            name = node.name.value.strip()
            if name in seen:
                what = f'there are two templates {name!r}'
                raise ModelFormatError(what, self._place(node.name), 'rename one of the two')
            seen.add(name)
            text = node.parameters
            parameters = parse(text.value, Start.PARAMETERS, self._place(text))
            yield name, Definition(name, tuple(parameters), node)

    def _system(self, instances: Instances) -> Iterator[tuple[Instance, int]]:
        lines: list[syntax.SystemLine] = []
        nodes = self._parsed(self._document.instantiation, Start.SYSTEM)
        for node in nodes + self._parsed(self._document.system, Start.SYSTEM):
            if isinstance(node, syntax.Instantiation):
                instances.define(node)
            elif isinstance(node, syntax.SystemLine):
                lines.append(node)
            else:
                self._declarations.declare([node], self._scope)
        if len(lines) != 1:
            place = self._place(self._document.system)
            raise ModelFormatError(
                f'the model has {len(lines)} system lines', place, 'write one: system A, B;'
            )
        for name, line in lines[0].names:
            for instance in instances.of_system_line(name, line):
                yield instance, line

    # -- processes -----------------------------------------------------------------------
    def _process(self, instance: Instance, result: Elaboration, line: int) -> None:
        node = instance.node
        scope = self._scope.inner()
        scope.names.update(instance.bindings)
        if id(node) not in self._local:
            self._local[id(node)] = self._parsed(node.declarations, Start.DECLARATIONS)
        self._declarations.declare(self._local[id(node)], scope, instance.name)
        indices, names = self._location_numbers(node)
        if node.initial not in indices:
            what = f'the initial location of {instance.name} does not exist'
            raise ModelFormatError(what, self._place(node.name), 'mark an initial location')
        edges = [edge for raw in node.edges for edge in self._edges(raw, scope, indices)]
        self._tables.processes.append(
            Process(
                name=instance.name,
                template=node.name.value.strip(),
                arguments=tuple(
                    symbol.expr.low
                    for symbol in instance.bindings.values()
                    if isinstance(symbol, ValueSymbol) and isinstance(symbol.expr, Const)
                ),
                locations=tuple(
                    Location(name, raw.urgent, raw.committed)
                    for name, raw in zip(names, node.locations, strict=True)
                ),
                initial=indices[node.initial],
                edges=tuple(edges),
            )
        )
        number = len(self._tables.processes) - 1
        symbol = ProcessSymbol(number, {name: i for i, name in enumerate(names)}, scope)
        result.scope.declare(instance.name, symbol, line)
        result.process_scopes[instance.name] = scope

    def _location_numbers(self, node: TemplateNode) -> tuple[dict[str, int], list[str]]:
        names = [raw.name or f'_{raw.id}' for raw in node.locations]
        seen: set[str] = set()
        for raw, name in zip(node.locations, names, strict=True):
            if name in seen:
                place = Place(self._document.file, raw.line)
                what = f'two locations are called {name!r}'
                raise ModelFormatError(what, place, 'rename one of the two')
            seen.add(name)
        return {raw.id: i for i, raw in enumerate(node.locations)}, names

    def _edges(self, raw: EdgeNode, outer: Scope, indices: dict[str, int]) -> Iterator[Edge]:
        place = Place(self._document.file, raw.line)
        for end in (raw.source, raw.target):
            if end not in indices:
                raise ModelFormatError(
                    f'an edge ends at {end!r}, which is no location', place, 'connect it again'
                )
        if id(raw) not in self._labels:
            self._labels[id(raw)] = _EdgeLabels(raw, self._document.file)
        labels = self._labels[id(raw)]
        for select, scope in self._selections(labels.selects, outer):
            guard = self._guard(labels.guard, scope)
            if isinstance(guard, Const) and not guard.low:
                continue
            self._edge_count += 1
            _refuse_too_many(self._edge_count, place)
            updates = [e for node in labels.updates for e in self._expressions.update(node, scope)]
            yield Edge(
                source=indices[raw.source],
                target=indices[raw.target],
                guard=None if isinstance(guard, Const) else guard,
                sync=self._sync(labels, scope),
                updates=tuple(e for e in updates if self._matters(e)),
                select=select,
                comment=labels.comment,
                place=place,
            )

    def _matters(self, update: Expr) -> bool:
        """Whether an update assigns anything, or may be an error."""
        may_fail = any(isinstance(node, (Call, Check)) for node in walk(update))
        return may_fail or has_effect(update, self._tables.functions)

    def _selections(
        self, selects: tuple[syntax.Select, ...], outer: Scope
    ) -> Iterator[tuple[tuple[tuple[str, int], ...], Scope]]:
        types = [self._expressions.types.integer(select.type, outer) for select in selects]
        if selects:
            # Reported before all their guards are evaluated.
            count = math.prod(declared.high - declared.low + 1 for declared in types)
            _refuse_too_many(count, outer.place(selects[0].line))
        for values in itertools.product(*(range(t.low, t.high + 1) for t in types)):
            scope = outer.inner()
            for select, declared, value in zip(selects, types, values, strict=True):
                scope.declare(select.name, ValueSymbol(declared, const(value)), select.line)
            names = (select.name for select in selects)
            yield tuple(zip(names, values, strict=True)), scope

    def _guard(self, node: syntax.Expression | None, scope: Scope) -> Expr:
        return truth(self._expressions.pure(node, scope, 'the guard')) if node else const(1)

    def _sync(self, labels: _EdgeLabels, scope: Scope) -> Sync | None:
        if labels.channel is None or labels.direction is None:
            return None
        reference = self._expressions.reference(labels.channel, scope)
        if not isinstance(reference.type, ChannelType):
            raise ModelFormatError(
                f'{reference.name} is no single channel',
                scope.place(labels.channel.line),
                'synchronise on a channel or on one element of a channel array',
            )
        if isinstance(reference.offset, Const):
            base = reference.base + reference.offset.low
            return Sync(labels.direction, base, 1, const(0))
        return Sync(labels.direction, reference.base, reference.length, reference.offset)


def _refuse_too_many(edges: int, place: Place) -> None:
    if edges > MAX_EDGES:
        what = f'selects and instances make more than {MAX_EDGES} edges'
        raise ModelFormatError(what, place, 'narrow the types of the selects')


class _EdgeLabels:
    """The labels of an edge, parsed once for all select values."""

    def __init__(self, raw: EdgeNode, file: str) -> None:
        self._raw, self._file = raw, file
        self.selects: tuple[syntax.Select, ...] = self._parse('select', Start.SELECTS) or ()
        self.guard: syntax.Expression | None = self._parse('guard', Start.CONDITION)
        self.updates: tuple[syntax.Expression, ...] = (
            self._parse('assignment', Start.UPDATES) or ()
        )
        self.channel: syntax.Expression | None = None
        self.direction: Direction | None = None
        comment = raw.labels.get('comments')
        self.comment = comment.value.strip() if comment else ''
        if 'synchronisation' in raw.labels:
            self._parse_sync(raw.labels['synchronisation'])

    def _parse_sync(self, text: Text) -> None:
        body = text.value.rstrip()
        place = Place(self._file, text.line)
        if body[-1] not in '!?':
            raise ModelFormatError(
                'the synchronisation has no direction', place, 'end it with ! or ?'
            )
        self.direction = Direction(body[-1])
        self.channel = parse(body[:-1], Start.CONDITION, place)

    def _parse(self, kind: str, start: Start) -> Any:
        text = self._raw.labels.get(kind)
        return parse(text.value, start, Place(self._file, text.line)) if text else None
