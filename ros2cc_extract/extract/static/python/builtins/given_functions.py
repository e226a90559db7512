"""
The standard library calls functions that it is given: at once, or when what it made of them is
called, left or dropped.

Source: library reference of CPython 3.12, ``functools``, ``operator``, ``itertools``, ``weakref``,
``types``, ``contextlib``.
"""

from __future__ import annotations

from functools import partial

from ros2cc_extract.extract.static.python.builtins.code_behind import (
    ACCESSORS,
    asked_as,
    with_accessor,
)
from ros2cc_extract.extract.static.python.machine.library_table import LibraryClass
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.objects.loops import any_of
from ros2cc_extract.extract.static.python.values.containers import Collection, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Class,
    Const,
    Function,
    Handler,
    Instance,
    Library,
    Native,
    Partial,
    Value,
    choice,
    options_of,
)

_CALLABLE = (Bound, Function, Partial)
_ON_EXIT = '__on_exit__'
_THING = '__thing__'


def called_at_once(machine: Machine, call: Call) -> None:
    """Code that calls a function for each item calls it perhaps, as there may be no item."""
    for given in (*call.args, *call.keywords.values()):
        for option in options_of(given):
            if isinstance(option, _CALLABLE):
                item = machine.mystery('item that a library gives', call.place, 'item')
                act = partial(machine.call, option, Call(call.place, _items(option, item)))
                machine.branch([act, lambda: NONE], call.place)


def _items(function: Value, item: Value) -> list[Value]:
    """As many items as the function takes: one, or two."""
    bound = function.function if isinstance(function, Bound) else function
    if not isinstance(bound, Function):
        return [item]
    arguments = bound.node.args
    number = len(arguments.posonlyargs) + len(arguments.args) - isinstance(function, Bound)
    return [item] * max(1, min(2, number))


def _reduce(machine: Machine, receiver: Value, call: Call) -> Value:
    called_at_once(machine, call)
    return machine.mystery('result of functools.reduce', call.place, 'reduce(…)')


def _methodcaller(machine: Machine, receiver: Value, call: Call) -> Value:
    name, given = (call.args[0] if call.args else NONE), call

    def caller(machine: Machine, receiver: Value, call: Call) -> Value:
        if not isinstance(name, Const) or not call.args:
            return machine.mystery('a method with a computed name', call.place)
        method = machine.attribute(call.args[0], str(name.value), call.place)
        return machine.call(method, Call(call.place, given.args[1:], given.keywords, given.more))

    return Native('operator.methodcaller', caller)


def _attrgetter(machine: Machine, receiver: Value, call: Call) -> Value:
    names = call.args

    def getter(machine: Machine, receiver: Value, call: Call) -> Value:
        owner = call.args[0] if call.args else NONE
        found = owner
        for name in names:
            found = owner
            for part in str(name.value).split('.') if isinstance(name, Const) else ():
                found = machine.attribute(found, part, call.place)
        is_one = len(names) == 1 and isinstance(names[0], Const)
        return found if is_one else machine.mystery('several attributes', call.place)

    return Native('operator.attrgetter', getter)


def _method_type(machine: Machine, receiver: Value, call: Call) -> Value:
    if len(call.args) != 2:
        return machine.mystery('a method of unknown parts', call.place, 'MethodType(…)')
    function, owner = call.args
    return (
        Bound(owner, function)
        if isinstance(function, Function)
        else Partial(function, (owner,), {})
    )


def method_of(machine: Machine, receiver: Value, call: Call) -> Value:
    """``function.__get__(owner)``: the method of that object."""
    owner = call.args[0] if call.args else NONE
    is_method = isinstance(receiver, Function) and isinstance(owner, Instance)
    return Bound(owner, receiver) if is_method else receiver  # type: ignore[arg-type]


def _members(machine: Machine, receiver: Value, call: Call) -> Value:
    """
    ``inspect.getmembers(owner, isfunction)``: the functions of its scanned classes, by name.

    Those of a library carry nothing of the program.
    """
    owner = call.args[0] if call.args else NONE
    predicate = call.argument(1, 'predicate')
    found = _functions_of(owner)
    if found is None or getattr(predicate, 'name', '') not in _OF_FUNCTIONS:
        return machine.mystery('members of an unknown object', call.place, 'getmembers(…)')
    rows = (
        Sequence((Const(name), machine.attribute(owner, name, call.place)), 'tuple')
        for name in sorted(found)
    )
    return Sequence(tuple(rows), 'list')


_OF_FUNCTIONS = frozenset(
    {'inspect.isfunction', 'inspect.ismethod', 'inspect.isroutine', 'builtins.callable'}
)


def _names(machine: Machine, receiver: Value, call: Call) -> Value:
    """``dir(owner)``, as far as the program has made what is there."""
    owner = call.args[0] if call.args else NONE
    if not isinstance(owner, (Class, Instance)) or not isinstance(_class_of(owner), Class):
        return machine.mystery('names of an unknown object', call.place, 'dir(…)')
    holders = [owner, *(cls for cls in owner.mro if isinstance(cls, Class))]
    names = {name for each in holders for name in each.slots if isinstance(name, str)}
    return Sequence(tuple(Const(name) for name in sorted(names)), 'list')


def _class_of(owner: Class | Instance) -> Value:
    return owner.cls if isinstance(owner, Instance) else owner


def _functions_of(owner: Value) -> set[str] | None:
    if not isinstance(owner, (Class, Instance)):
        return None
    classes = [cls for cls in owner.mro if isinstance(cls, Class)]
    return {
        name
        for cls in classes
        for name, value in cls.slots.items()
        if isinstance(value, Function) and value.binding != 'property'
    }


def _reference(machine: Machine, receiver: Value, call: Call) -> Value:
    """A weak reference: calling it gives the object, or ``None`` once that is gone."""
    thing = call.args[0] if call.args else NONE
    return Native('weakref.ref', lambda *_: choice([thing, NONE]))


def _proxy(machine: Machine, receiver: Value, call: Call) -> Value:
    return call.args[0] if call.args else NONE


def _property(machine: Machine, receiver: Value, call: Call) -> Value:
    """``property(get, set, delete)``."""
    given = [call.argument(number, name) for number, name in enumerate(('fget', 'fset', 'fdel'))]
    known = next((each for each in given if isinstance(each, Function)), None)
    if known is None:
        return machine.mystery('a property of unknown functions', call.place, 'property(…)')
    made: Function = Function(known.node, known.module, known.qualname, known.scope)
    made.owner, made.binding = known.owner, 'property'
    made.defaults = known.defaults
    made.keyword_defaults.update(known.keyword_defaults)
    for kind, accessor in zip(ACCESSORS, given[1:], strict=True):
        made = with_accessor(machine, made, kind, accessor) or made
    return made


def _namespace(machine: Machine, receiver: Value, call: Call) -> Value:
    """``types.SimpleNamespace(name=value)``."""
    if isinstance(receiver, Instance):
        for name, value in call.keywords.items():
            machine.store.write(receiver, name, value)
    return NONE


def _holds_code(call: Call) -> bool:
    """A name space of plain data is data, which only assignments change."""
    given = (option for value in call.keywords.values() for option in options_of(value))
    return any(isinstance(option, (*_CALLABLE, Instance)) for option in given)


def _keep_for_exit(machine: Machine, stack: Value, function: Value) -> None:
    if isinstance(stack, Instance):
        machine.store.write(stack, _ON_EXIT, (*stack.slots.get(_ON_EXIT, ()), function))


def _callback(machine: Machine, receiver: Value, call: Call) -> Value:
    """``stack.callback(function, …)``."""
    function = call.args[0] if call.args else NONE
    _keep_for_exit(machine, receiver, Partial(function, tuple(call.args[1:]), call.keywords))
    return function


def _push(machine: Machine, receiver: Value, call: Call) -> Value:
    """``stack.push(exit)``: a function like ``__exit__``, or an object that has it."""
    given = call.args[0] if call.args else NONE
    method = machine.special_method(given, '__exit__', call.place)
    if method is not None or isinstance(given, _CALLABLE):
        _keep_for_exit(machine, receiver, Partial(method or given, (NONE, NONE, NONE), {}))
    return given


def _enter(machine: Machine, receiver: Value, call: Call) -> Value:
    """``stack.enter_context(c)`` enters ``c`` until the stack's own block is left."""
    context = call.argument(0, 'cm') or NONE
    entered = machine.enter_context(context, call.place)
    method = machine.special_method(context, '__exit__', call.place)
    if method is not None:
        _keep_for_exit(machine, receiver, Partial(method, (NONE, NONE, NONE), {}))
    return entered


def _leave(machine: Machine, receiver: Value, call: Call) -> Value:
    """A stack is left or closed: what it keeps is called, last first."""
    kept = receiver.slots.get(_ON_EXIT, ()) if isinstance(receiver, Instance) else ()
    for function in reversed(kept):
        for option in options_of(function):
            if isinstance(option, Partial):
                machine.run_if_coroutine(machine.call(option, Call(call.place)), call.place)
    if isinstance(receiver, Instance):
        machine.store.write(receiver, _ON_EXIT, ())
    return NONE


def _self(machine: Machine, receiver: Value, call: Call) -> Value:
    return receiver


def _ignored(machine: Machine, receiver: Value, call: Call) -> Value:
    return NONE


def _close_later(machine: Machine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance):
        machine.store.write(receiver, _THING, call.args[0] if call.args else NONE)
    return NONE


def _thing(machine: Machine, receiver: Value, call: Call) -> Value:
    thing = receiver.slots.get(_THING) if isinstance(receiver, Instance) else None
    return thing if isinstance(thing, Value) else NONE


def _close(machine: Machine, receiver: Value, call: Call) -> Value:
    close = machine.attribute(_thing(machine, receiver, call), 'close', call.place)
    return machine.call(close, Call(call.place))


_STACK = LibraryClass(
    init=_ignored,
    methods={
        'enter_context': _enter,
        'enter_async_context': _enter,
        'callback': _callback,
        'push_async_callback': _callback,
        'push': _push,
        'push_async_exit': _push,
        'pop_all': _self,
        'close': _leave,
        'aclose': _leave,
        '__enter__': _self,
        '__aenter__': _self,
        '__exit__': _leave,
        '__aexit__': _leave,
    },
)

_OF_BUILTINS = ('abs', 'bytes', 'format', 'hash', 'repr', 'round')
_ASKING = {
    **{f'builtins.{name}': name for name in _OF_BUILTINS},
    'copy.copy': 'copy',
    'copy.deepcopy': 'deepcopy',
    'math.ceil': 'float',
    'math.floor': 'float',
    'operator.index': 'index',
}
_AT_ONCE = ('itertools.', 'heapq.', 'bisect.', 'statistics.', 're.sub')


def run_by(machine: Machine, function: Library, call: Call) -> None:
    """What code that is not followed runs at once of what it is given."""
    if function.name.startswith(_AT_ONCE):
        called_at_once(machine, call)
    elif function.name in _ASKING and call.args:
        asked_as(machine, call.args[0], _ASKING[function.name], call.place)


def _next(machine: Machine, receiver: Value, call: Call) -> Value:
    """``next(items, default)``: one of the items, where all of them are known."""
    given = options_of(call.args[0]) if call.args else ()
    items = [any_of(each) if isinstance(each, Collection) else None for each in given]
    known = [item for item in items if item is not None]
    if known and len(known) == len(items):
        return choice([*known, *call.args[1:2]])
    if call.args:
        asked_as(machine, call.args[0], 'next', call.place)
    return machine.mystery('result of next', call.place, 'next(…)')


FUNCTIONS: dict[str, Handler] = {
    'builtins.next': _next,
    'functools.reduce': _reduce,
    'operator.methodcaller': _methodcaller,
    'operator.attrgetter': _attrgetter,
    'types.MethodType': _method_type,
    'inspect.getmembers': _members,
    'builtins.dir': _names,
    'weakref.ref': _reference,
    'weakref.WeakMethod': _reference,
    'weakref.proxy': _proxy,
    'builtins.property': _property,
}

CLASSES = {
    'types.SimpleNamespace': LibraryClass(init=_namespace, matters=_holds_code),
    'contextlib.ExitStack': _STACK,
    'contextlib.AsyncExitStack': _STACK,
    'contextlib.closing': LibraryClass(
        init=_close_later, methods={'__enter__': _thing, '__exit__': _close}
    ),
}
