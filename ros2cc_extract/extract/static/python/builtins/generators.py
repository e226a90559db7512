"""
Generators: the body of a generator function runs where items are taken from it.

What it does is done by the code that takes them: a callback that calls ``next`` on a generator
that the constructor has made waits for what the body waits for. All of the body is followed
there, once.
"""

from __future__ import annotations

import ast
from typing import Any

from ros2cc_extract.extract.static.program.text_queries import noted_on
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.containers import Generator, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Function,
    Native,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.source_locations import Place

_TAKING = frozenset({'__next__', 'send', 'throw'})
_KEEPING = frozenset({'builtins.iter', 'append', 'appendleft', 'add', 'insert', 'setdefault'})
_INNER = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)


def is_generator(function: Function) -> bool:
    """Whether a call of ``function`` runs nothing of it yet."""
    return noted_on(function.node, 'is_generator', _yields)


def _yields(node: ast.AST) -> bool:
    if not isinstance(node, ast.FunctionDef):
        return False
    waiting: list[ast.AST] = [*node.body]
    while waiting:
        part = waiting.pop()
        if isinstance(part, (ast.Yield, ast.YieldFrom)):
            return True
        if not isinstance(part, _INNER):
            waiting.extend(ast.iter_child_nodes(part))
    return False


def run(machine: Machine, value: Value, place: Place) -> None:
    """Items are taken from ``value``: if it is a generator, its body runs."""
    if not isinstance(value, Generator):
        return
    # While nothing is noted, or in the set-up, the run itself stands for who takes the items.
    taker: Any = machine.world.effects or machine.world
    if value.slots.get('taker') is taker:
        return
    machine.store.write(value, 'taker', taker)
    machine.store.write(value, 'items', ())
    made = machine.run_function(value.function, _at(value.call, place))
    if isinstance(made, Sequence):
        machine.store.write(value, 'items', made.items)
        machine.store.write(value, 'open', made.others)
        machine.store.write(value, 'many', made.many)
        yielding, held = machine.world.yielding or (None, ())
        machine.store.write(value, 'held', held if yielding is made else ())


def run_given(machine: Machine, function: Value, call: Call) -> None:
    """Code that is not followed may take items from the generators that it gets."""
    if isinstance(function, Native) and function.name in _KEEPING:
        return
    for given in (*call.args, *call.keywords.values()):
        for option in options_of(given):
            run(machine, option, call.place)


def method(name: str, value: Generator) -> Value | None:
    """A method of a generator."""
    if name in _TAKING:
        return Native(name, _next, value)
    return Native(name, lambda *_: NONE, value) if name == 'close' else None


def _next(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Generator)
    run(machine, receiver, call.place)
    unknown = machine.mystery('item of a generator', call.place, 'next(…)')
    return choice([*receiver.items, unknown]) if receiver.items else unknown


def _at(call: Call, place: Place) -> Call:
    """The same call, made where the items are taken; on one line it stays where it stands."""
    if (call.place.file, call.place.line) == (place.file, place.line):
        return call
    return Call(place, call.args, call.keywords, call.more, call.text, call.sources)
