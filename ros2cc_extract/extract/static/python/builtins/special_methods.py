"""
Methods that Python calls by itself: for a test, for a text, for a number.

Source: CPython 3.12, language reference, "Special method names".
"""

from __future__ import annotations

from functools import partial

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import NONE, Call, Value, options_of
from ros2cc_extract.source_locations import Place

TRUTH = ('__bool__', '__len__')
TEXT = ('__str__', '__repr__')
FORMATTED = ('__format__', *TEXT)
OF_FUNCTIONS = {
    'builtins.int': ('__int__', '__index__'),
    'builtins.float': ('__float__', '__index__'),
    'builtins.complex': ('__complex__', '__float__'),
    'builtins.bool': TRUTH,
    'builtins.str': TEXT,
    'builtins.repr': ('__repr__',),
    'builtins.format': FORMATTED,
    'builtins.print': TEXT,
    'builtins.bytes': ('__bytes__',),
    'builtins.hash': ('__hash__',),
    'builtins.abs': ('__abs__',),
    'builtins.round': ('__round__',),
    'builtins.reversed': ('__reversed__',),
    'math.floor': ('__floor__', '__float__'),
    'math.ceil': ('__ceil__', '__float__'),
    'math.trunc': ('__trunc__',),
    'operator.index': ('__index__',),
    'copy.copy': ('__copy__',),
    'copy.deepcopy': ('__deepcopy__',),
}
"""What a function of Python asks its arguments for; the first one that their class has."""


def run(machine: Machine, value: Value, names: tuple[str, ...], place: Place) -> None:
    """Call the first of ``names`` that the class of ``value`` has, on each of its options."""
    options = options_of(value)
    methods = [
        next(filter(None, (machine.special_method(each, name, place) for name in names)), None)
        for each in options
    ]
    if not any(methods):
        return
    acts = [
        partial(machine.call, method, Call(place)) if method is not None else lambda: NONE
        for method in methods
    ]
    if len(acts) > 1:
        machine.branch(acts, place)
    else:
        acts[0]()


def run_for_text(machine: Machine, value: Value, place: Place) -> None:
    """``'…' % value``: the texts of a tuple's items, or of the one value."""
    for each in value.items if isinstance(value, Sequence) else (value,):
        run(machine, each, TEXT, place)


def run_for_function(machine: Machine, name: str, call: Call) -> None:
    """What the arguments of a function of Python are asked for."""
    names = OF_FUNCTIONS.get(name)
    if names is not None:
        for each in call.args:
            run(machine, each, names, call.place)
