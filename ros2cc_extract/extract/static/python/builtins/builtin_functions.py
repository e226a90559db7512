"""Python's own functions and the parts of its standard library that set-up code uses."""

from __future__ import annotations

import ast
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from ros2cc_extract.extract.static.python.builtins import (
    builtin_methods,
    dispatching,
    generators,
    given_functions,
    heaps_and_chains,
)
from ros2cc_extract.extract.static.python.builtins.code_behind import asked_as
from ros2cc_extract.extract.static.python.builtins.given_functions import called_at_once
from ros2cc_extract.extract.static.python.builtins.map_and_zip import filtered, mapped, zipped
from ros2cc_extract.extract.static.python.builtins.methods_by_name import get_attribute
from ros2cc_extract.extract.static.python.builtins.sorting import identity, in_order
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.path_facts import of_items
from ros2cc_extract.extract.static.python.objects import loops
from ros2cc_extract.extract.static.python.objects.dataclass_fields import field
from ros2cc_extract.extract.static.python.objects.iterators import iterator
from ros2cc_extract.extract.static.python.objects.memoization import keep_results
from ros2cc_extract.extract.static.python.values import constant_folding
from ros2cc_extract.extract.static.python.values.assumed_defaults import by_default
from ros2cc_extract.extract.static.python.values.caught_errors import Caught
from ros2cc_extract.extract.static.python.values.containers import (
    Collection,
    Fields,
    Generator,
    Mapping,
    Sequence,
)
from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    NONE,
    Bound,
    Call,
    Choice,
    Class,
    Const,
    Function,
    Handler,
    Instance,
    Mystery,
    Native,
    Partial,
    Super,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.source_locations import Unknown

_RANGE_LIMIT = 100_000


def _range(machine: Machine, receiver: Value, call: Call) -> Value:
    mystery = next((arg for arg in call.args if isinstance(arg, Mystery)), None)
    default = _of_defaults(_range, machine, call)
    if mystery is not None and default is not None:
        return Mystery(mystery.unknown, 'range(…)', default)
    bounds = [arg.value for arg in call.args if isinstance(arg, Const)]
    if len(bounds) != len(call.args) or not all(isinstance(bound, int) for bound in bounds):
        reason = mystery.unknown.reason if mystery else 'range of unknown length'
        return Sequence((), 'range', Unknown(reason, call.place))
    try:
        numbers = range(*bounds)
    except (TypeError, ValueError):
        return Sequence((), 'range', Unknown('bad range', call.place))
    if numbers[_RANGE_LIMIT:]:  # its length may be more than Python counts
        return Sequence((), 'range', Unknown('a very long range', call.place))
    return Sequence(tuple(Const(number) for number in numbers), 'range')


def _of_defaults(handler: Handler, machine: Machine, call: Call) -> Value | None:
    """What a function gives for the defaults of its arguments, where one of these is open."""
    if call.more is not None or call.keywords:
        return None
    return by_default(
        call.args, lambda *defaults: handler(machine, NONE, Call(call.place, list(defaults)))
    )


def _enumerate(machine: Machine, receiver: Value, call: Call) -> Value:
    default = _of_defaults(_enumerate, machine, call)
    if default is not None and isinstance(call.args[0], Mystery):
        return Mystery(call.args[0].unknown, call.args[0].text, default)
    items = loops.items_in(machine, call.args[0] if call.args else NONE, call.place)
    start = call.argument(1, 'start')
    first = start.value if isinstance(start, Const) and isinstance(start.value, int) else 0
    pairs: list[Value] = []
    many: dict[Value, Value] = {}
    for position, item in enumerate(items.known):
        number: Value = Const(first + position)
        if many or items.why_many(item) is not None:
            number = machine.mystery('position in a collection of unknown size', call.place, 'i')
        pairs.append(Sequence((number, item), 'tuple'))
        why = items.why_many(item)
        if why is not None:
            many[pairs[-1]] = Mystery(why)
    return Sequence(tuple(pairs), 'list', items.others, many)


def _converted(kind: str) -> Handler:
    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        if not call.args:
            return Sequence((), kind)
        items = loops.items_in(machine, call.args[0], call.place)
        return Sequence(items.known, kind, items.others, items.many)

    return handler


def _iter(machine: Machine, receiver: Value, call: Call) -> Value:
    if len(call.args) == 1 and isinstance(call.args[0], Generator):
        return call.args[0]
    return iterator(call) or _converted('list')(machine, receiver, call)


def _set(machine: Machine, receiver: Value, call: Call) -> Value:
    if not call.args:
        return Sequence((), 'set')
    return loops.set_of(loops.items_in(machine, call.args[0], call.place), call.place)


def _reversed(machine: Machine, receiver: Value, call: Call) -> Value:
    given = call.args[0] if call.args else NONE
    asked_as(machine, given, 'reversed', call.place)
    items = loops.items_in(machine, given, call.place)
    return Sequence(items.known[::-1], 'list', items.others, items.many)


def _dict(machine: Machine, receiver: Value, call: Call) -> Value:
    entries: dict[Value, Value] = {}
    rest = call.more
    many: dict[Value, Value] = {}
    if call.args and isinstance(call.args[0], Mapping):
        entries.update(call.args[0].entries)
        many.update(call.args[0].many)
        rest = rest or call.args[0].others
    elif call.args:
        rest = rest or _fill_with_pairs(machine, call, entries, many)
    entries.update({Const(name): value for name, value in call.keywords.items()})
    return Mapping(entries, rest, many)


def _fill_with_pairs(
    machine: Machine, call: Call, entries: dict[Value, Value], many: dict[Value, Value]
) -> Unknown | None:
    """The entries of ``dict(pairs)``; returns why there may be others."""
    pairs = loops.items_in(machine, call.args[0], call.place)
    rest = pairs.others
    for pair in pairs.known:
        why = pairs.why_many(pair)
        for option in options_of(pair):
            if not isinstance(option, Sequence) or len(option.items) != 2:
                rest = rest or Unknown('a pair that could not be followed', call.place)
                continue
            key, value = option.items
            entries[key] = choice([value, ABSENT]) if isinstance(pair, Choice) else value
            if why is not None or not loops.is_key(key):
                many[key] = Mystery(why) if why is not None else NONE
    return rest


def _len(machine: Machine, receiver: Value, call: Call) -> Value:
    length = _length(machine, call)
    if isinstance(length, Mystery):
        length.is_plain = True
    return length


def _length(machine: Machine, call: Call) -> Value:
    value = call.args[0] if call.args else NONE
    method = machine.special_method(value, '__len__', call.place)
    if method is not None:
        return machine.call(method, Call(call.place))
    if isinstance(value, Mystery) and isinstance(value.default, Sequence):
        return Mystery(value.unknown, f'len({value.text})', _of_defaults(_len, machine, call))
    if isinstance(value, Collection) and loops.may_be_filled(machine, value):
        return machine.mystery('length when the program runs', call.place, 'len(…)')
    if (
        isinstance(value, Sequence)
        and value.rest is None
        and not any(isinstance(item, Choice) for item in value.items)
    ):
        return Const(len(value.items))
    if isinstance(value, Mapping) and value.rest is None:
        return Const(len(value.entries))
    if isinstance(value, Const) and isinstance(value.value, (str, bytes)):
        return Const(len(value.value))
    return machine.mystery('length that could not be followed', call.place, 'len(…)')


def _letter(function: Callable[[Any], object]) -> Handler:
    """``ord`` or ``chr``."""

    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        if len(call.args) == 1 and isinstance(call.args[0], Const):
            with suppress(TypeError, ValueError, OverflowError):
                return Const(function(call.args[0].value))
        return machine.mystery(f'{function.__name__}() of an unknown value', call.place)

    return handler


def _scalar(kind: type) -> Handler:
    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        value = call.args[0] if call.args else Const(kind())
        asked_as(machine, value, kind.__name__, call.place)
        if isinstance(value, Const) and len(call.args) < 2:
            try:
                return Const(kind(value.value))
            except (TypeError, ValueError, OverflowError):
                return machine.mystery(f'{kind.__name__}() of a bad value', call.place)
        if kind is bool:
            truth = machine.truth(value)
            return value if truth is None else Const(truth)
        if isinstance(value, Mystery) and value.default is not None:
            default = by_default(
                [value], lambda held: handler(machine, NONE, Call(call.place, [held]))
            )
            return Mystery(value.unknown, value.text, default)
        return (
            value
            if isinstance(value, Mystery)
            else machine.mystery(f'{kind.__name__}() of an unknown value', call.place)
        )

    return handler


def _of_all(*, stops_on: bool) -> Handler:
    """``any(…)`` and ``all(…)`` of what objects answer."""

    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        given = call.args[0] if call.args else NONE
        items = loops.items_in(machine, given, call.place)
        is_known = items.others is None
        answer = of_items(items.known, call, stops_on=stops_on) if is_known else None
        return answer or machine.mystery('any or all of several', call.place, call.text or '')

    return handler


def _key_of(call: Call) -> dict[str, Value]:
    return {name: value for name, value in call.keywords.items() if name == 'key'}


def _extreme(act: str) -> Handler:
    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        values = call.args
        if len(values) == 1:
            values = list(machine.items_of(values[0], call.place)[0])
        called_at_once(machine, Call(call.place, [], _key_of(call)))
        numbers = [value.value for value in values if isinstance(value, Const)]
        if numbers and len(numbers) == len(values) and not call.keywords and not call.more:
            try:
                return Const(max(numbers) if act == 'max' else min(numbers))
            except TypeError:
                pass
        mystery = next((value for value in call.args if isinstance(value, Mystery)), None)
        default = _of_defaults(handler, machine, call)
        if mystery is not None and default is not None:
            return Mystery(mystery.unknown, f'{act}(…)', default)
        return machine.mystery(f'{act}() of unknown values', call.place, f'{act}(…)')

    return handler


def _setattr(machine: Machine, receiver: Value, call: Call) -> Value:
    owner = call.args[0] if call.args else NONE
    own = machine.special_method(owner, '__setattr__', call.place)
    if own is not None:
        return machine.call(own, Call(call.place, call.args[1:]))
    return builtin_methods.set_attribute_of(machine, receiver, call)


def _hasattr(machine: Machine, receiver: Value, call: Call) -> Value:
    if len(call.args) == 2 and isinstance(call.args[1], Const):
        exists = machine.has_attribute(call.args[0], str(call.args[1].value))
        if exists is not None:
            return Const(exists)
    return machine.mystery('hasattr', call.place, 'hasattr(…)')


def _isinstance(machine: Machine, receiver: Value, call: Call) -> Value:
    value, wanted = (*call.args, NONE, NONE)[:2]
    classes = wanted.items if isinstance(wanted, Sequence) else (wanted,)
    if isinstance(value, Instance):
        if any(cls in value.mro for cls in classes):
            return Const(True)
        if all(isinstance(cls, Class) for cls in (*value.mro, *classes)):
            return Const(False)
    if isinstance(value, Caught) and any(value.is_surely(cls) for cls in classes):
        return Const(True)
    if isinstance(value, Const) and classes and all(isinstance(cls, Class) for cls in classes):
        return Const(False)
    return machine.mystery('isinstance', call.place, 'isinstance(…)')


def _vars(machine: Machine, receiver: Value, call: Call) -> Value:
    owner = call.args[0] if call.args else NONE
    if isinstance(owner, Instance):
        return Fields(owner)
    return machine.mystery('vars', call.place, 'vars(…)')


def _callable(machine: Machine, receiver: Value, call: Call) -> Value:
    value = call.args[0] if call.args else NONE
    if isinstance(value, (Function, Bound, Class, Partial, Native)):
        return Const(True)
    if isinstance(value, Const):
        return Const(False)
    return machine.mystery('callable', call.place, 'callable(…)')


def _super(machine: Machine, receiver: Value, call: Call) -> Value:
    if len(call.args) == 2 and isinstance(call.args[0], Class):
        return Super(call.args[0], call.args[1])
    return machine.mystery('super()', call.place)


def _type(machine: Machine, receiver: Value, call: Call) -> Value:
    value = call.args[0] if call.args else NONE
    if len(call.args) == 1 and isinstance(value, Instance):
        return value.cls
    return machine.mystery('type()', call.place, 'type(…)')


def _print(machine: Machine, receiver: Value, call: Call) -> Value:
    for each in call.args:
        asked_as(machine, each, 'str', call.place)
    return NONE


def _exit(machine: Machine, receiver: Value, call: Call) -> Value:
    machine.stop_program()
    return NONE


def _partial(machine: Machine, receiver: Value, call: Call) -> Value:
    if not call.args:
        return machine.mystery('partial without a function', call.place, 'partial()')
    function = call.args[0]
    bare = function.function if isinstance(function, Bound) else function
    if isinstance(bare, Function) and machine.world.effects is None:
        for value in (*call.args[1:], *call.keywords.values()):
            machine.note_held(bare, 'partial', value)
    return Partial(function, tuple(call.args[1:]), dict(call.keywords), call.more)


def _wraps(machine: Machine, receiver: Value, call: Call) -> Value:
    """``wraps(f)`` gives a decorator that lends the name of ``f`` to its function."""
    named = call.args[0] if call.args else NONE

    def decorate(machine: Machine, receiver: Value, inner: Call) -> Value:
        function = inner.args[0] if inner.args else NONE
        if isinstance(function, Function) and isinstance(named, (Function, Bound)):
            machine.store.write(function, '__wrapped__', named)
        return function

    return Native('wraps(…)', decorate)


def _same(machine: Machine, receiver: Value, call: Call) -> Value:
    """Decorators such as ``contextmanager`` that leave the function what it is."""
    if call.args and isinstance(call.args[0], (Function, Class)):
        return call.args[0]
    return Native('decorator', _same)


def _deque(machine: Machine, receiver: Value, call: Call) -> Value:
    return _converted('deque')(machine, receiver, Call(call.place, call.args[:1]))


def _defaultdict(machine: Machine, receiver: Value, call: Call) -> Value:
    made = Mapping({}, Unknown('defaultdict', call.place) if call.args else None)
    made.fills = bool(call.args)
    made.slots['factory'] = call.args[0] if call.args else NONE
    return made


def _environment(machine: Machine, receiver: Value, call: Call) -> Value:
    return machine.mystery('an environment variable', call.place, 'environment variable')


def _sum(machine: Machine, receiver: Value, call: Call) -> Value:
    items, rest = machine.items_of(call.args[0], call.place) if call.args else ((), None)
    total: Value = Const(0)
    for item in items:
        total = constant_folding.binary(ast.Add(), total, item) or machine.mystery(
            'sum', call.place
        )
    return total if rest is None else machine.mystery('sum of unknown values', call.place)


_FUNCTIONS: dict[str, Handler] = {
    'builtins.range': _range,
    'builtins.enumerate': _enumerate,
    'builtins.zip': zipped,
    'builtins.list': _converted('list'),
    'builtins.tuple': _converted('tuple'),
    'builtins.set': _set,
    'builtins.frozenset': _set,
    'builtins.sorted': in_order,
    'builtins.id': identity,
    'builtins.iter': _iter,
    'builtins.reversed': _reversed,
    'builtins.dict': _dict,
    'builtins.len': _len,
    'builtins.int': _scalar(int),
    'builtins.float': _scalar(float),
    'builtins.str': _scalar(str),
    'builtins.bool': _scalar(bool),
    'builtins.ord': _letter(ord),
    'builtins.chr': _letter(chr),
    'builtins.anext': generators.anext_of,
    'builtins.any': _of_all(stops_on=True),
    'builtins.all': _of_all(stops_on=False),
    'builtins.max': _extreme('max'),
    'builtins.min': _extreme('min'),
    'builtins.sum': _sum,
    'builtins.getattr': get_attribute,
    'builtins.setattr': _setattr,
    'builtins.hasattr': _hasattr,
    'builtins.isinstance': _isinstance,
    'builtins.callable': _callable,
    'builtins.vars': _vars,
    'builtins.super': _super,
    'builtins.map': mapped,
    'builtins.filter': filtered,
    'builtins.type': _type,
    'builtins.print': _print,
    'builtins.exit': _exit,
    'builtins.quit': _exit,
    'sys.exit': _exit,
    'os._exit': _exit,
    'functools.partial': _partial,
    'functools.wraps': _wraps,
    'functools.lru_cache': keep_results,
    'functools.cache': keep_results,
    'contextlib.contextmanager': _same,
    'contextlib.asynccontextmanager': _same,
    'dataclasses.dataclass': _same,
    'dataclasses.field': field,
    'attr.ib': field,
    'attr.field': field,
    'attrs.field': field,
    'collections.deque': _deque,
    'collections.OrderedDict': _dict,
    'collections.defaultdict': _defaultdict,
    'os.getenv': _environment,
    'os.environ.get': _environment,
}


def _import_module(machine: Machine, receiver: Value, call: Call) -> Value:
    """``importlib.import_module('pkg.mod')``; a relative name needs its package."""
    name = call.argument(0, 'name')
    text = name.value if isinstance(name, Const) else None
    if isinstance(text, str) and not text.startswith('.'):
        return machine.import_module(text, call.place)
    return machine.mystery('a module whose name is computed', call.place, 'import_module()')


_CLOCKS = ('time', 'monotonic', 'perf_counter', 'process_time', 'thread_time')

TABLE = Library(
    classes={
        'builtins.object': LibraryClass(init=lambda *_: NONE),
        **given_functions.CLASSES,
    },
    functions={
        **_FUNCTIONS,
        **given_functions.FUNCTIONS,
        **heaps_and_chains.FUNCTIONS,
        **dispatching.FUNCTIONS,
        'importlib.import_module': _import_module,
    },
    constants={
        'os.name': Const('posix'),
        'sys.platform': Const('linux'),
        'typing.TYPE_CHECKING': Const(False),
    },
    plain=frozenset(f'time.{clock}{unit}' for clock in _CLOCKS for unit in ('', '_ns')),
)
