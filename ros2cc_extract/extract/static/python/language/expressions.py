"""Evaluating expressions."""

from __future__ import annotations

import ast
from collections.abc import Callable
from functools import partial
from typing import Any

from ros2cc_extract.extract.static.python.branching import conditions, narrowed_types, open_tests
from ros2cc_extract.extract.static.python.branching.order_of_text import Asked
from ros2cc_extract.extract.static.python.builtins import (
    absent_attributes,
    code_behind,
    generators,
)
from ros2cc_extract.extract.static.python.builtins.code_behind import operated
from ros2cc_extract.extract.static.python.language.call_expressions import evaluate_call
from ros2cc_extract.extract.static.python.language.subscripts import slice_alone, subscript
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import AccessKind
from ros2cc_extract.extract.static.python.objects import iterators, loops
from ros2cc_extract.extract.static.python.objects.iterators import RepeatedCall
from ros2cc_extract.extract.static.python.objects.unset_globals import unset_global
from ros2cc_extract.extract.static.python.values import constant_folding, enumerations
from ros2cc_extract.extract.static.python.values.assumed_defaults import by_default
from ros2cc_extract.extract.static.python.values.containers import Collection, Mapping, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    NONE,
    NOT_FOLDED,
    Call,
    Choice,
    Class,
    Const,
    Instance,
    Library,
    Mystery,
    Native,
    Scope,
    Value,
    choice,
    is_number_or_text,
    options_of,
    present,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import When

_DEPTH_LIMIT = 120


class Expressions(Machine):
    """The expressions of the language."""

    depth = 0

    def evaluate(self, node: ast.expr, frame: Frame) -> Value:
        """The value of an expression."""
        self.steps += 1
        handler = _EXPRESSIONS.get(type(node))
        if handler is None:
            return self.mystery('expression that is not followed', frame.place(node))
        if self.depth > _DEPTH_LIMIT:
            return self.mystery('expression nested too deeply', frame.place(node))
        self.depth += 1
        try:
            value: Value = handler(self, node, frame)
        finally:
            self.depth -= 1
        if frame.narrowed and isinstance(value, Choice):
            return narrowed_types.narrowed(self, node, value, frame)
        return value

    def look_up(self, name: str, scope: Scope) -> Value | None:
        """The value of a name, from the inside out; ``None`` when nothing defines it."""
        inner: Scope | None = None if name in scope.global_names else scope
        while inner is not None:
            if name in inner.slots:
                found: Value = inner.slots[name]
                return found
            inner = inner.parent
        value = scope.module.slots.get(name)
        return value if isinstance(value, Value) else None

    def items_of(self, value: Value, place: Any) -> tuple[tuple[Value, ...], Unknown | None]:
        """What iterating over ``value`` gives, and why there may be more."""
        if isinstance(value, Sequence):
            generators.run(self, value, place)
            return value.items, value.rest
        if isinstance(value, Mapping):
            return tuple(value.entries), value.rest
        if isinstance(value, Const) and isinstance(value.value, str):
            return tuple(Const(letter) for letter in value.value), None
        if isinstance(value, Class) and (members := enumerations.members_of(value)):
            return tuple(members), None
        if isinstance(value, Choice):
            return (), Unknown('one of several sequences, depending on a branch', place)
        if isinstance(value, Mystery):
            return (), Unknown(value.unknown.reason, value.unknown.at or place)
        if isinstance(value, RepeatedCall):
            reason = Unknown('as many items as the call gives before the sentinel', place)
            return (self.call(value.function, Call(place)),), reason
        own = iterators.iterated(self, value, place)
        if own is not value:
            return self.items_of(own, place)
        step = iterators.next_of(self, value, place) if isinstance(value, Instance) else None
        if step is not None:
            return (step(),), Unknown('as many items as the object gives', place)
        self.note_results(value, place)
        return (), Unknown('a sequence that could not be followed', place)

    def truth(self, value: Value) -> bool | None:
        """``bool(value)``; ``None`` when that depends."""
        if isinstance(value, Const):
            return bool(value.value)
        if isinstance(value, (Sequence, Mapping)):
            known = value.items if isinstance(value, Sequence) else tuple(value.entries)
            if any(item is not ABSENT and not _may_be_absent(value, item) for item in known):
                return True
            is_open = bool(value.rest or known) or loops.may_be_filled(self, value)
            return None if is_open else False
        if isinstance(value, Choice):
            truths = {self.truth(option) for option in options_of(value)}
            return truths.pop() if len(truths) == 1 else None
        if isinstance(value, Instance):
            return None if value.state is None and self._has_truth_method(value) else True
        if isinstance(value, (Mystery, Library)):
            return None
        return True

    def operate(
        self, op: ast.operator, left: Value, right: Value, frame: Frame, node: ast.AST
    ) -> Value:
        """``left op right``."""
        if isinstance(left, Sequence) and isinstance(right, Sequence) and isinstance(op, ast.Add):
            self.charge(len(left.items) + len(right.items))
            rest = left.others or right.others
            many = {**left.many, **right.many}
            return Sequence((*left.items, *right.items), left.kind, rest, many)
        if isinstance(left, Sequence) and isinstance(op, ast.Mult):
            return _repeated(self, left, right, frame.place(node))
        if isinstance(left, Instance) or isinstance(right, Instance):
            is_augmented = isinstance(node, ast.AugAssign)
            place = frame.place(node)
            given = operated(self, op, left, right, place, augmented=is_augmented)
            if given is not None:
                return given
        if isinstance(op, ast.Mod) and isinstance(left, Const) and isinstance(left.value, str):
            code_behind.asked_for_texts(self, right, frame.place(node))
        folded = constant_folding.binary(op, left, right)
        if folded is not None:
            return folded
        later = self.library_operation(op, left, right)
        if later is not None:
            return later
        for side in (left, right):
            if isinstance(side, Mystery):
                text = node if isinstance(node, ast.BinOp) else side.text
                default = by_default([left, right], partial(constant_folding.binary, op))
                return _computed(Mystery(side.unknown, text, default), left, right)
        return _computed(self.mystery(NOT_FOLDED, frame.place(node)), left, right)

    def _has_truth_method(self, value: Instance) -> bool:
        return isinstance(value.cls, Class) and any(
            name in cls.slots
            for cls in value.mro
            if isinstance(cls, Class)
            for name in ('__bool__', '__len__')
        )


def _computed(result: Mystery, left: Value, right: Value) -> Mystery:
    """What is computed from numbers, or from texts, is one itself."""
    result.is_plain = is_number_or_text(left) and is_number_or_text(right)
    return result


def _may_be_absent(owner: Collection, item: Value) -> bool:
    """An item of one branch, or one that stands for any number of items."""
    is_of_a_branch = isinstance(item, Choice) and ABSENT in item.options
    return is_of_a_branch or owner.many.get(item, NONE) != NONE


def _name(machine: Expressions, node: ast.Name, frame: Frame) -> Value:
    value = machine.look_up(node.id, frame.scope)
    if value == NONE and machine.world.when is not When.START:
        value = _global_as_of_now(machine, node, frame)
    if value is not None:
        open_tests.note_name(machine, node.id, value, frame)
        if machine.world.effects is not None:
            _note_name(machine, node, frame)
        return present(value) if isinstance(value, Choice) else value
    builtin = machine.library(f'builtins.{node.id}')
    if isinstance(builtin, (Native, Const)) or constant_folding.is_builtin(node.id):
        return builtin
    for star in frame.module.stars:
        if isinstance(star, Library):
            known = machine.library(f'{star.name}.{node.id}')
            if not isinstance(known, Mystery):
                return known
    return machine.mystery(f'name {node.id!r} is not defined here', frame.place(node), node.id)


def _global_as_of_now(machine: Expressions, node: ast.Name, frame: Frame) -> Value:
    """``None`` in a global that functions assign may be anything once the set-up is over."""
    held = frame.module.slots.get(node.id)
    if held != NONE or node.id in frame.scope.slots:
        return NONE
    if node.id not in machine.changed_globals(frame.module):
        return NONE
    reason = f'global {node.id!r} is assigned by functions'
    return unset_global(machine, node, frame, reason) or NONE


def _note_name(machine: Expressions, node: ast.Name, frame: Frame) -> None:
    inner: Scope | None = frame.scope
    while inner is not None:
        if node.id in inner.slots:
            machine.note_cell(inner, node.id, AccessKind.READ, frame.place(node))
            return
        inner = inner.parent
    machine.note_global(frame.module, node.id, AccessKind.READ, frame.place(node))


def _constant(machine: Expressions, node: ast.Constant, frame: Frame) -> Value:
    return Const(node.value)


def _attribute(machine: Expressions, node: ast.Attribute, frame: Frame) -> Value:
    machine.world.reading.note_use(node.value, frame.place(node.value))
    owner = machine.evaluate(node.value, frame)
    if owner == NONE:
        owner = unset_global(machine, node.value, frame) or owner
    place, name = frame.place(node), frame.attribute_name(node.attr)
    if machine.world.effects is not None:
        for option in options_of(owner):
            machine.note_attribute(option, name, AccessKind.READ, place)
    text: str | ast.expr = node if isinstance(owner, (Mystery, Const)) else ''
    if isinstance(owner, Choice):
        options = options_of(owner)
        set_ones = [o for o in options if o != NONE] or options
        able = [o for o in set_ones if machine.has_attribute(o, name) is not False]
        return choice([machine.attribute(o, name, place) for o in able or options])
    found = machine.attribute(owner, name, place, text)
    if isinstance(owner, Mystery):
        machine.note_held(owner, name, found)
    elif isinstance(found, Mystery) and machine.world.effects is not None:
        absent_attributes.note_use(machine, owner, node, frame)
    return found


def _collection(kind: str) -> Callable[[Expressions, Any, Frame], Value]:
    def handler(machine: Expressions, node: ast.List | ast.Tuple | ast.Set, frame: Frame) -> Value:
        items: list[Value] = []
        rest: Unknown | None = None
        many: dict[Value, Value] = {}
        for element in node.elts:
            if isinstance(element, ast.Starred):
                value = machine.evaluate(element.value, frame)
                more = loops.items_in(machine, value, frame.place(element))
                machine.charge(len(more.known))
                items.extend(more.known)
                many.update(more.many)
                rest = rest or more.others
            else:
                items.append(machine.evaluate(element, frame))
        return Sequence(tuple(items), kind, rest, many)

    return handler


def _dictionary(machine: Expressions, node: ast.Dict, frame: Frame) -> Value:
    entries: dict[Value, Value] = {}
    rest: Unknown | None = None
    many: dict[Value, Value] = {}
    for key_node, value_node in zip(node.keys, node.values, strict=True):
        value = machine.evaluate(value_node, frame)
        if key_node is None:
            if isinstance(value, Mapping):
                entries.update(value.entries)
                many.update(value.many)
                rest = rest or value.others
            else:
                rest = Unknown('spread dictionary that could not be followed', frame.place(node))
            continue
        key = machine.evaluate(key_node, frame)
        entries[key] = value
        if loops.is_key(key):
            machine.name_value(value, loops.key_text(key))
        else:
            many[key] = NONE
    return Mapping(entries, rest, many)


def _binary(machine: Expressions, node: ast.BinOp, frame: Frame) -> Value:
    machine.world.reading.note_operands(node, frame.module.file)
    left = machine.evaluate(node.left, frame)
    right = machine.evaluate(node.right, frame)
    return machine.operate(node.op, left, right, frame, node)


def _repeated(machine: Expressions, left: Sequence, right: Value, place: Place) -> Value:
    if isinstance(right, Const) and isinstance(right.value, int) and right.value <= 1000:
        times = max(right.value, 0)
        machine.charge(len(left.items) * times)
        return Sequence(left.items * times, left.kind, left.others, left.many)
    return Sequence(left.items, left.kind, Unknown('unknown length', place))


def _formatted(machine: Expressions, node: ast.JoinedStr, frame: Frame) -> Value:
    parts: list[str] = []
    held: list[Value] = []
    mystery: Mystery | None = None
    for part in node.values:
        value = machine.evaluate(part, frame)
        held.append(value)
        if isinstance(value, Const):
            parts.append(str(value.value))
        elif mystery is None:
            mystery = value if isinstance(value, Mystery) else None
            mystery = mystery or machine.mystery('f-string part not followed', frame.place(part))
    if mystery is not None:
        return Mystery(mystery.unknown, node, by_default(held, _joined_text))
    text = constant_folding.joined(parts)
    return text or machine.mystery('a text that grows too long', frame.place(node))


def _joined_text(*parts: Value) -> Value | None:
    texts = [str(part.value) for part in parts if isinstance(part, Const)]
    return constant_folding.joined(texts) if len(texts) == len(parts) else None


def _formatted_part(machine: Expressions, node: ast.FormattedValue, frame: Frame) -> Value:
    value = machine.evaluate(node.value, frame)
    kind = {ord('r'): 'repr', ord('s'): 'str'}.get(node.conversion, 'format')
    code_behind.asked_as(machine, value, kind, frame.place(node.value))
    if node.conversion == -1 and node.format_spec is None:
        return value
    if isinstance(value, Const) and node.conversion == -1 and node.format_spec is not None:
        spec = machine.evaluate(node.format_spec, frame)
        if isinstance(spec, Const):
            return constant_folding.formatted(value, str(spec.value)) or value
    if isinstance(value, Const) and node.conversion == ord('r'):
        return Const(repr(value.value))
    return value if not isinstance(value, Const) else Const(str(value.value))


def _lambda(machine: Expressions, node: ast.Lambda, frame: Frame) -> Value:
    return machine.make_function(node, frame)


def _named(machine: Expressions, node: ast.NamedExpr, frame: Frame) -> Value:
    value = open_tests.evaluate_copied(machine, node.value, [node.target], frame)
    machine.assign(node.target, value, frame)
    return value


def _await(machine: Expressions, node: ast.Await, frame: Frame) -> Value:
    asked = Asked(machine, frame.place(node))
    value = machine.evaluate(node.value, frame)
    asked.all_read()
    result = machine.await_value(value, frame.place(node))
    asked.done()
    return result


def _yield(machine: Expressions, node: ast.Yield, frame: Frame) -> Value:
    value = machine.evaluate(node.value, frame) if node.value else NONE
    frame.held = frame.held if frame.yields else machine.world.held
    frame.yields.append(value)
    if node is machine.world.first_yield:
        machine.world.first_yield = None
        machine.stop_program()
    if isinstance(machine.world.count, Unknown):
        frame.many[value] = machine.why_many()
    elif machine.world.path != frame.path:
        frame.many[value] = machine.mystery('yielded under a condition', frame.place(node))
    return machine.mystery('value sent to a generator', frame.place(node))


def _yield_from(machine: Expressions, node: ast.YieldFrom, frame: Frame) -> Value:
    given = machine.evaluate(node.value, frame)
    with generators.handed_on(machine):
        items = loops.items_in(machine, given, frame.place(node))
    frame.yields.extend(items.known)
    frame.many.update(items.many)
    if items.others is not None:
        other = Mystery(items.others, node.value)
        frame.yields.append(other)
        frame.many[other] = other
    return machine.mystery('result of a generator', frame.place(node))


def _comprehension(machine: Expressions, node: ast.expr, frame: Frame) -> Value:
    return machine.comprehend(node, frame)


def _starred(machine: Expressions, node: ast.Starred, frame: Frame) -> Value:
    return machine.evaluate(node.value, frame)


_EXPRESSIONS: dict[type[ast.expr], Callable[..., Value]] = {
    ast.Name: _name,
    ast.Constant: _constant,
    ast.Attribute: _attribute,
    ast.Call: evaluate_call,
    ast.List: _collection('list'),
    ast.Tuple: _collection('tuple'),
    ast.Set: _collection('set'),
    ast.Dict: _dictionary,
    ast.Subscript: subscript,
    ast.Slice: slice_alone,
    ast.IfExp: conditions.if_expression,
    ast.BoolOp: conditions.boolean,
    ast.UnaryOp: conditions.unary,
    ast.BinOp: _binary,
    ast.Compare: conditions.compare,
    ast.JoinedStr: _formatted,
    ast.FormattedValue: _formatted_part,
    ast.Lambda: _lambda,
    ast.NamedExpr: _named,
    ast.Await: _await,
    ast.Yield: _yield,
    ast.YieldFrom: _yield_from,
    ast.ListComp: _comprehension,
    ast.SetComp: _comprehension,
    ast.GeneratorExp: _comprehension,
    ast.DictComp: _comprehension,
    ast.Starred: _starred,
}
