"""``functools.singledispatch``: which function is called rests on the class of an argument."""

from __future__ import annotations

from functools import partial

from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.containers import Collection, collection_class
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Class,
    Const,
    Function,
    Handler,
    Instance,
    Library,
    Native,
    Scope,
    Value,
    options_of,
)

METHOD = 'functools.singledispatchmethod'
_FUNCTION = 'functools.singledispatch'
_REGISTERED = '(registered)'
_BUILTIN = 'builtins.'
_Registered = tuple[tuple[Value, Value], ...]


def _dispatcher(name: str, position: int) -> Handler:
    """
    Make what calls one of several functions.

    :param position: of the argument that is asked for its class.
    """

    def dispatch(machine: Machine, receiver: Value, call: Call) -> Value:
        return _dispatched(machine, receiver, call, position)

    def made(machine: Machine, receiver: Value, call: Call) -> Value:
        function = call.args[0] if call.args else NONE
        if not isinstance(function, Function):
            return machine.mystery(f'{name} of an unknown function', call.place, name)
        function.slots[_REGISTERED] = ()
        return Native(name, dispatch, function)

    return made


def member(value: Native, name: str) -> Value | None:
    """``register`` of such a function."""
    is_meant = name == 'register' and value.name in (_FUNCTION, METHOD)
    return Native(name, _register, value) if is_meant else None


def _register(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Native)
    given = call.args[0] if call.args else NONE
    if len(call.args) > 1:
        return _add(receiver, given, call.args[1])
    if isinstance(given, Function):
        return _add(receiver, _annotated(machine, receiver, given), given)

    def decorate(machine: Machine, _: Value, inner: Call) -> Value:
        return _add(receiver, given, inner.args[0] if inner.args else NONE)

    return Native('register', decorate)


def _add(dispatcher: Native, kind: Value, function: Value) -> Value:
    default = dispatcher.receiver
    assert isinstance(default, Function)
    default.slots[_REGISTERED] = (*default.slots[_REGISTERED], (kind, function))
    return function


def _annotated(machine: Machine, dispatcher: Native, function: Function) -> Value:
    """The class that the annotation of the argument names."""
    arguments = function.node.args
    parameters = [*arguments.posonlyargs, *arguments.args][dispatcher.name == METHOD :]
    annotation = parameters[0].annotation if parameters else None
    if annotation is None:
        return machine.mystery('an argument without annotation', function.place)
    return machine.evaluate(annotation, Frame(Scope(function.module, function.scope)))


def _dispatched(machine: Machine, default: Value, call: Call, position: int) -> Value:
    assert isinstance(default, Function)
    asked = call.args[position] if len(call.args) > position else NONE
    known: _Registered = default.slots[_REGISTERED]
    meant = [each for option in options_of(asked) for each in _meant(known, default, option)]
    calls = [partial(machine.call, each, call) for each in dict.fromkeys(meant)]
    return calls[0]() if len(calls) == 1 else machine.branch(calls, call.place)


def _meant(known: _Registered, default: Function, asked: Value) -> list[Value]:
    """The functions that may be called for ``asked``."""
    for name in _classes_of(asked):
        found = [function for kind, function in known if _is_class(kind, name)]
        if found:
            return found[-1:]
    everything = [*(function for _, function in known), default]
    is_known = bool(_classes_of(asked)) and all(_is_plain(kind) for kind, _ in known)
    return [default] if is_known else everything


def _classes_of(value: Value) -> list[Value | str]:
    if isinstance(value, Instance):
        return list(value.mro)
    if isinstance(value, Collection):
        return [_BUILTIN + collection_class(value)]
    if isinstance(value, Const):
        names = [each.__name__ for each in type(value.value).__mro__]
        return [_BUILTIN + name for name in names]
    return []


def _is_class(kind: Value, name: Value | str) -> bool:
    if isinstance(kind, Library):
        return kind.name == (name.name if isinstance(name, Library) else name)
    is_native = isinstance(kind, Native) and isinstance(name, str)
    return kind is name or (is_native and kind.name == name)  # type: ignore[attr-defined]


def _is_plain(kind: Value) -> bool:
    """A class of the program, or one of Python's own that is no abstract one."""
    is_builtin = isinstance(kind, (Library, Native)) and kind.name.startswith(_BUILTIN)
    return isinstance(kind, Class) or is_builtin


FUNCTIONS: dict[str, Handler] = {
    _FUNCTION: _dispatcher(_FUNCTION, 0),
    METHOD: _dispatcher(METHOD, 1),
}
