"""Calls as the source writes them: what is called, with which arguments."""

from __future__ import annotations

import ast
from typing import Any

from ros2cc_extract.extract.static.program.text_queries import CHANGING_METHODS
from ros2cc_extract.extract.static.python.branching import narrowed_types, open_tests
from ros2cc_extract.extract.static.python.branching.order_of_text import Asked
from ros2cc_extract.extract.static.python.builtins import computed_names, executed_texts
from ros2cc_extract.extract.static.python.language.try_blocks import is_lack_uncaught
from ros2cc_extract.extract.static.python.machine.dependences import computed_from
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import ITSELF, AccessKind
from ros2cc_extract.extract.static.python.objects import loops, unset_globals
from ros2cc_extract.extract.static.python.objects.element_keys import note_item
from ros2cc_extract.extract.static.python.values.containers import Mapping
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Const,
    Function,
    Mystery,
    Native,
    Value,
)
from ros2cc_extract.spec.effects import ADDS, EMPTIES, TAKES, TAKES_ANY

_OF_ONE_ITEM = frozenset({'pop', 'remove', 'discard'})
_BY_KEY = frozenset({'get', 'setdefault'})


def evaluate_call(machine: Machine, node: ast.Call, frame: Frame) -> Value:
    if isinstance(node.func, ast.Name) and node.func.id == 'super' and not node.args:
        return machine.zero_argument_super(frame)
    _note_heap(machine, node, frame)
    machine.world.reading.note_use(node.func, frame.place(node.func))
    _note_choice(machine, node, frame)
    function = _called(machine, node, frame)
    asked = Asked(machine, frame.place(node))
    call = arguments(machine, node, frame)
    asked.all_read()
    if isinstance(function, (Bound, Function)) and asked.has_waited():
        call.place = frame.end_of(node)  # in the order of the text it comes after its arguments
    machine.note_call(function, node, frame)
    if isinstance(function, Mystery) or call.more is not None:
        call.text = node
    if isinstance(function, Native):
        unset_globals.pass_on(machine, node, call, frame)
    if isinstance(function, Native) and function.name == 'vars' and len(call.args) == 1:
        return machine.attribute(call.args[0], '__dict__', call.place)
    if isinstance(function, Native) and function.name in ('locals', 'globals', 'vars'):
        return machine.mystery(f'{function.name}()', call.place)
    machine.world.reading.calls += 1
    if isinstance(node.func, ast.Attribute):
        computed_names.note_hidden(machine, function, node.func.attr, call)
    result = executed_texts.executed(machine, function, call, node, frame)
    if result is None:
        result = machine.call(function, call)
    asked.done()
    if isinstance(function, Native) and function.name == 'builtins.isinstance':
        return narrowed_types.answer_of(machine, node, function, call, result, frame)
    return result


def _called(machine: Machine, call: ast.Call, frame: Frame) -> Value:
    """The function of a call; a method that changes its owner in place is an update of it."""
    node = call.func
    if (
        machine.world.effects is None
        or not isinstance(node, ast.Attribute)
        or node.attr not in CHANGING_METHODS
        or not isinstance(node.value, (ast.Attribute, ast.Name))
    ):
        function = machine.evaluate(node, frame)
        _note_within(machine, node, frame)
        return function
    machine.note_part(node.value, frame, f'.{node.attr}')
    noted, machine.world.effects = machine.world.effects, None
    function = machine.evaluate(node, frame)
    machine.world.refilling = node.attr == 'update' and _refills(machine, call, node.value, frame)
    machine.world.effects = noted
    machine.world.moves = TAKES_ANY if _takes_any(machine, call) else _MOVES.get(node.attr)
    machine.world.given_from = _given_from(call, node.value, frame)
    key = _only_key(call)
    if key is not None:
        note_item(machine, node.value, key, frame)
    machine.note_update(node.value, frame, AccessKind.UPDATE_IN_PLACE)
    machine.world.moves, machine.world.refilling = None, False
    machine.world.given_from = frozenset()
    return function


def _given_from(call: ast.Call, owner: ast.expr, frame: Frame) -> frozenset[str]:
    """The shared data that a change of a collection is computed from."""
    given = [*call.args, *(each.value for each in call.keywords)]
    own = ast.dump(owner)
    is_own = any(
        isinstance(part, type(owner)) and ast.dump(part) == own
        for each in given
        for part in ast.walk(each)
    )
    names = frozenset[str]().union(*(computed_from(each, frame.sources) for each in given))
    return names | {ITSELF} if is_own else names


def _only_key(call: ast.Call) -> ast.expr | None:
    """``d.update(n=…)``, ``d.__setitem__('n', …)``, ``d.pop('n')``: the key, if it is one."""
    assert isinstance(call.func, ast.Attribute)
    if call.func.attr == 'pop' and call.args and isinstance(call.args[0], ast.Constant):
        return call.args[0] if isinstance(call.args[0].value, str) else None
    if call.func.attr == '__setitem__' and call.args:
        return call.args[0]
    if call.func.attr != 'update' or len(call.args) + len(call.keywords) != 1:
        return None
    if call.keywords:
        name = call.keywords[0].arg
        return ast.Constant(name) if name is not None else None
    given = call.args[0]
    return given.keys[0] if isinstance(given, ast.Dict) and len(given.keys) == 1 else None


def _refills(machine: Machine, call: ast.Call, owner: ast.expr, frame: Frame) -> bool:
    """``self.state.update(mode='x')``: whether the dictionary has all of these keys already."""
    keys: list[object] = [each.arg for each in call.keywords]
    for argument in call.args:
        given = argument.keys if isinstance(argument, ast.Dict) else [None]
        keys += [each.value if isinstance(each, ast.Constant) else None for each in given]
    known = machine.evaluate(owner, frame)
    return None not in keys and all(loops.has_key(known, Const(key)) for key in keys)


def _takes_any(machine: Machine, call: ast.Call) -> bool:
    """``d.popleft()``, ``d.pop(0)``: fails where nothing is left, and nobody catches that."""
    if not isinstance(call.func, ast.Attribute) or call.func.attr not in _NEXT:
        return False
    at = call.args[0] if call.args else None
    at = at.operand if isinstance(at, ast.UnaryOp) else at
    is_next = at is None or (isinstance(at, ast.Constant) and type(at.value) is int)
    is_next = is_next and len(call.args) < _WITH_DEFAULT
    return is_next and is_lack_uncaught(machine)


_WITH_DEFAULT = 2
_NEXT = frozenset({'pop', 'popleft', 'popitem'})

_MOVES = {
    **dict.fromkeys(('append', 'appendleft', 'add', 'extend', 'extendleft'), ADDS),
    **dict.fromkeys(('pop', 'popleft', 'popitem', 'remove', 'discard'), TAKES),
    'clear': EMPTIES,
}


def _note_choice(machine: Machine, node: ast.Call, frame: Frame) -> None:
    """``self.free.remove(slot)``: which item is meant may have been looked up before."""
    function = node.func
    if machine.world.effects is None or not isinstance(function, ast.Attribute):
        return
    if function.attr in _BY_KEY and node.args:
        note_item(machine, function.value, node.args[0], frame)
    elif function.attr in _OF_ONE_ITEM and node.args:
        sources, place = computed_from(node.args[0], frame.sources), frame.place(function.value)
        machine.world.reading.note_choice(function.value, sources, place)


def _note_heap(machine: Machine, node: ast.Call, frame: Frame) -> None:
    """``heapq.heappop(self.rows)`` changes its argument in place (``heapq``)."""
    function = node.func
    name = function.attr if isinstance(function, ast.Attribute) else getattr(function, 'id', '')
    if name.startswith('heap') and node.args and machine.world.effects is not None:
        machine.note_update(node.args[0], frame, AccessKind.UPDATE_IN_PLACE)


def _note_within(machine: Machine, node: ast.expr, frame: Frame) -> None:
    """``self.rows[k].append(x)`` leaves ``self.rows`` as it is, and changes what lies in it."""
    if not isinstance(node, ast.Attribute) or node.attr not in CHANGING_METHODS:
        return
    target = node.value
    while isinstance(target, ast.Subscript):
        target = target.value
    if target is not node.value and isinstance(target, (ast.Attribute, ast.Name)):
        machine.note_update(target, frame, AccessKind.WITHIN)


def arguments(machine: Machine, node: ast.Call, frame: Frame) -> Call:
    """Evaluate the arguments of a call, starred ones spread out."""
    call = Call(frame.place(node))
    for argument in node.args:
        if isinstance(argument, ast.Starred):
            value = machine.evaluate(argument.value, frame)
            items, rest = machine.items_of(value, frame.place(argument))
            machine.charge(len(items))
            call.args.extend(items)
            call.more = call.more or rest
        else:
            at = len(call.args) if call.more is None else None
            call.args.append(open_tests.evaluate_argument(machine, argument, frame, call, at))
    for keyword in node.keywords:
        value = open_tests.evaluate_argument(machine, keyword.value, frame, call, keyword.arg)
        if keyword.arg is not None:
            call.keywords[keyword.arg] = value
        else:
            _spread(machine, value, call, frame.place(keyword.value))
    return call


def _spread(machine: Machine, value: Value, call: Call, place: Any) -> None:
    if isinstance(value, Mapping):
        for key, item in value.entries.items():
            if isinstance(key, Const) and isinstance(key.value, str):
                call.keywords[key.value] = item
        call.more = call.more or value.rest
    else:
        call.more = call.more or machine.items_of(value, place)[1]
