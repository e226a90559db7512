"""Methods of Python's own lists, dictionaries and strings."""

from __future__ import annotations

from typing import Any

from ros2cc_extract.extract.static.python.builtins import computed_names
from ros2cc_extract.extract.static.python.builtins.given_functions import called_at_once
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import AccessKind
from ros2cc_extract.extract.static.python.objects import loops
from ros2cc_extract.extract.static.python.objects.escape import note_kept
from ros2cc_extract.extract.static.python.values import constant_folding
from ros2cc_extract.extract.static.python.values.containers import Fields, Mapping, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Class,
    Const,
    Handler,
    Instance,
    Mystery,
    Native,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown

_TEXT_LIMIT = 100_000
_COPIED_A_STEP = 64

_TEXT_METHODS = frozenset(
    [
        'lower',
        'upper',
        'strip',
        'lstrip',
        'rstrip',
        'title',
        'capitalize',
        'replace',
        'removeprefix',
        'removesuffix',
        'format',
        'startswith',
        'endswith',
        'zfill',
    ]
)


def method(value: Sequence | Mapping | Const, name: str) -> Value | None:
    """The method ``name`` of a built-in value, ``None`` when it is not followed."""
    if isinstance(value, Const):
        known = isinstance(value.value, str) and name in (*_TEXT_METHODS, 'split', 'join')
        return Native(f'str.{name}', _text_method(name), value) if known else None
    table = _SEQUENCE if isinstance(value, Sequence) else _MAPPING
    handler = table.get(name)
    return Native(name, handler, value) if handler else None


def set_attribute(machine: Machine, receiver: Value, call: Call) -> Value:
    """``owner.__setattr__(name, value)``; a name that is not known changes nothing here."""
    name, value = (*call.args, NONE, NONE)[:2]
    if isinstance(receiver, (Instance, Class)) and isinstance(name, Const):
        machine.name_value(value, str(name.value))
        machine.set_attribute(receiver, str(name.value), value, call.place)
    else:
        computed_names.keep(machine, receiver, name, value, call.place)
    return NONE


def set_attribute_of(machine: Machine, _receiver: Value, call: Call) -> Value:
    """``object.__setattr__(owner, name, value)``."""
    owner = call.args[0] if call.args else NONE
    return set_attribute(machine, owner, Call(call.place, call.args[1:]))


def attribute_of(machine: Machine, receiver: Value, call: Call) -> Value:
    """``object.__getattribute__(owner, name)``, or that of an object."""
    given = call.args if receiver == NONE else [receiver, *call.args]
    owner, name = (*given, NONE, NONE)[:2]
    if isinstance(name, Const) and isinstance(name.value, str):
        return machine.attribute(owner, name.value, call.place)
    return machine.mystery('attribute with a computed name', call.place, '__getattribute__')


def field_method(value: Fields, name: str) -> Value | None:
    """A method of ``owner.__dict__``, ``None`` when it is not followed."""
    handler = _FIELDS.get(name)
    return Native(name, handler, value) if handler else None


def field(machine: Machine, fields: Fields, key: Value, place: Place) -> Value | None:
    """``owner.__dict__[key]``; ``None`` where nothing of that name is known."""
    if not isinstance(key, Const):
        return machine.mystery('attribute with a computed name', place, '__dict__')
    name = str(key.value)
    held = held_field(machine, fields, name, place)
    return machine.attribute_as_of_now(fields.owner, name, held, place) if held else None


def held_field(machine: Machine, fields: Fields, name: str, place: Place) -> Value | None:
    """What is known under a name of ``owner.__dict__``, which is asked for it."""
    machine.note_attribute(fields.owner, name, AccessKind.READ, place)
    held = fields.owner.slots.get(name)
    if isinstance(held, Value):
        return held
    if machine.world.in_callback:
        machine.world.lacking.append((fields.owner, name))
    return None


def _get_field(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Fields)
    found = field(machine, receiver, call.args[0] if call.args else NONE, call.place)
    default = call.argument(1) or NONE
    return found or default


def _set_field_once(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Fields)
    key, value = (*call.args, NONE, NONE)[:2]
    found = field(machine, receiver, key, call.place)
    if found is None and isinstance(key, Const):
        machine.store_field(receiver.owner, str(key.value), value, call.place)
    elif found is None or not isinstance(key, Const):
        computed_names.keep(machine, receiver.owner, key, value, call.place)
    return found or value


def _update_fields(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Fields)
    given: dict[Value, Value] = {}
    for argument in call.args:
        given |= argument.entries if isinstance(argument, Mapping) else {}
    given |= {Const(name): value for name, value in call.keywords.items()}
    for key, value in given.items():
        if isinstance(key, Const):
            machine.store_field(receiver.owner, str(key.value), value, call.place)
        else:
            computed_names.keep(machine, receiver.owner, key, value, call.place)
    return NONE


_FIELDS: dict[str, Handler] = {
    'get': _get_field,
    'setdefault': _set_field_once,
    'update': _update_fields,
}


def _text_method(name: str) -> Handler:
    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        assert isinstance(receiver, Const)
        if name == 'join':
            return _joined(machine, receiver, call)
        if (
            all(isinstance(arg, Const) for arg in (*call.args, *call.keywords.values()))
            and call.more is None
        ):
            return _applied(machine, receiver, name, call)
        return machine.mystery(f'text from str.{name}', call.place, f'str.{name}')

    return handler


def _applied(machine: Machine, receiver: Const, name: str, call: Call) -> Value:
    args = [arg.value for arg in call.args if isinstance(arg, Const)]
    keywords = {k: arg.value for k, arg in call.keywords.items() if isinstance(arg, Const)}
    try:
        large = _is_large(receiver.value, name, [*args, *keywords.values()])
        result = None if large else getattr(receiver.value, name)(*args, **keywords)
    except (TypeError, ValueError, LookupError, AttributeError, MemoryError):
        result = None
    if isinstance(result, list):
        return Sequence(tuple(Const(part) for part in result))
    if isinstance(result, (str, bool)):
        return Const(result)
    return machine.mystery(f'text from str.{name}', call.place, f'str.{name}')


def _is_large(text: str, name: str, args: list[Any]) -> bool:
    """Whether a result could be much longer than what the source shows."""
    if name == 'format' and (
        constant_folding.is_wide(text) or any(constant_folding.is_wide(str(a)) for a in args)
    ):
        return True
    if any(isinstance(arg, int) and abs(arg) > _TEXT_LIMIT for arg in args):
        return True
    longest = max((len(arg) for arg in args if isinstance(arg, str)), default=0)
    return (len(text) + 1) * (longest + 1) > _TEXT_LIMIT


def _joined(machine: Machine, receiver: Const, call: Call) -> Value:
    items, rest = machine.items_of(call.args[0], call.place) if call.args else ((), None)
    texts = [item.value for item in items if isinstance(item, Const)]
    if (
        rest is None
        and len(texts) == len(items)
        and all(isinstance(t, str) for t in texts)
        and sum(len(text) + len(receiver.value) for text in texts) < _TEXT_LIMIT
    ):
        return Const(receiver.value.join(texts))
    return machine.mystery('text from str.join', call.place, 'str.join')


def _append(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Sequence)
    if call.args:
        item = call.args[-1]
        note_kept(machine.world, item, call.place)
        machine.charge(len(receiver.items) // _COPIED_A_STEP)
        machine.store.write(receiver, 'items', (*receiver.items, item))
        if isinstance(machine.world.count, Unknown):
            many = {option: machine.why_many() for option in options_of(item)}
            machine.store.write(receiver, 'many', {**receiver.many, **many})
    return NONE


def _extend(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Sequence)
    more = loops.items_in(machine, call.args[0] if call.args else NONE, call.place)
    machine.charge(len(more.known))
    machine.store.write(receiver, 'items', (*receiver.items, *more.known))
    machine.store.write(receiver, 'open', receiver.others or more.others)
    machine.store.write(receiver, 'many', {**receiver.many, **more.many})
    return NONE


def _insert(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Sequence)
    if len(call.args) == 2:
        index = loops.index_of(call.args[0], len(receiver.items) + 1)
        at = len(receiver.items) if index is None else index
        items = receiver.items
        machine.store.write(receiver, 'items', (*items[:at], call.args[1], *items[at:]))
    return NONE


def _pop(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Sequence)
    position = call.argument(0) or Const(-1)
    index = loops.index_of(position, len(receiver.items))
    if index is None or receiver.rest is not None:
        return _popleft(machine, receiver, call)
    items = receiver.items
    machine.store.write(receiver, 'items', (*items[:index], *items[index + 1 :]))
    return items[index]


def _popleft(machine: Machine, receiver: Value, call: Call) -> Value:
    """One of those that are in it by then, where these are things of the program."""
    assert isinstance(receiver, Sequence)
    one_of_all = loops.any_of(receiver)
    return one_of_all or machine.mystery('item popped from a list', call.place, 'pop()')


def _clear(machine: Machine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Sequence):
        machine.store.write(receiver, 'items', ())
    else:
        machine.store.write(receiver, 'entries', {})  # type: ignore[arg-type]
    machine.store.write(receiver, 'open', None)  # type: ignore[arg-type]
    machine.store.write(receiver, 'many', {})  # type: ignore[arg-type]
    return NONE


def _copy(machine: Machine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Sequence):
        return Sequence(receiver.items, receiver.kind, receiver.others, receiver.many)
    assert isinstance(receiver, Mapping)
    return Mapping(dict(receiver.entries), receiver.others, receiver.many)


def _sort(machine: Machine, receiver: Value, call: Call) -> Value:
    key = call.argument(None, 'key')
    called_at_once(machine, Call(call.place, [key] if key is not None else []))
    return NONE


def _unordered(machine: Machine, receiver: Value, call: Call) -> Value:
    """``remove`` and the like: what is left is not followed item by item."""
    if isinstance(receiver, Sequence) and call.args and call.args[0] in receiver.items:
        index = receiver.items.index(call.args[0])
        items = receiver.items
        machine.store.write(receiver, 'items', (*items[:index], *items[index + 1 :]))
    return NONE


def _get(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Mapping)
    key = call.args[0] if call.args else NONE
    if loops.is_key(key) and key in receiver.entries:
        return receiver.entries[key]
    if receiver.rest is None and loops.is_key(key):
        return call.argument(1, 'default') or NONE
    one_of_all = None if loops.is_key(key) else loops.any_of(receiver)
    if one_of_all is not None:
        return choice([one_of_all, call.argument(1, 'default') or NONE])
    reason = receiver.rest.reason if receiver.rest else 'key that could not be followed'
    label = f'get({key.value!r})' if isinstance(key, Const) else 'get(…)'
    return Mystery(Unknown(reason, call.place), label)


def _setdefault(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Mapping)
    found = _get(machine, receiver, call)
    if found is NONE or isinstance(found, Mystery) or found is call.argument(1, 'default'):
        value = call.argument(1, 'default') or NONE
        note_kept(machine.world, value, call.place)
        if loops.is_key(call.args[0]):
            machine.store.write(receiver, 'entries', {**receiver.entries, call.args[0]: value})
            return value
    return found


def _update(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Mapping)
    entries, rest, many = dict(receiver.entries), receiver.others, dict(receiver.many)
    for argument in call.args:
        if isinstance(argument, Mapping):
            entries.update(argument.entries)
            many.update(argument.many)
            rest = rest or argument.others
        else:
            rest = rest or Unknown('updated from an unknown dictionary', call.place)
    entries.update({Const(name): value for name, value in call.keywords.items()})
    machine.store.write(receiver, 'entries', entries)
    machine.store.write(receiver, 'open', rest or call.more)
    machine.store.write(receiver, 'many', many)
    return NONE


def _pop_entry(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Mapping)
    found = _get(machine, receiver, call)
    if call.args and loops.is_key(call.args[0]) and call.args[0] in receiver.entries:
        entries = {k: v for k, v in receiver.entries.items() if k != call.args[0]}
        machine.store.write(receiver, 'entries', entries)
    return found


def _view(kind: str) -> Handler:
    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        assert isinstance(receiver, Mapping)
        entries = receiver.entries
        items: tuple[Value, ...] = tuple(entries)
        if kind == 'values':
            items = tuple(entries.values())
        elif kind == 'items':
            items = tuple(Sequence((key, value), 'tuple') for key, value in entries.items())
        many = {
            item: receiver.many[key]
            for item, key in zip(items, entries, strict=True)
            if key in receiver.many
        }
        return Sequence(items, 'list', receiver.others, many)

    return handler


_SEQUENCE: dict[str, Handler] = {
    'append': _append,
    'add': _append,
    'appendleft': _append,
    'put': _append,
    'put_nowait': _append,
    'extend': _extend,
    'update': _extend,
    'insert': _insert,
    'pop': _pop,
    'popleft': _popleft,
    'clear': _clear,
    'copy': _copy,
    'remove': _unordered,
    'discard': _unordered,
    'sort': _sort,
    'reverse': lambda machine, receiver, call: NONE,
}

_MAPPING: dict[str, Handler] = {
    'get': _get,
    'setdefault': _setdefault,
    'update': _update,
    'pop': _pop_entry,
    'keys': _view('keys'),
    'values': _view('values'),
    'items': _view('items'),
    'clear': _clear,
    'copy': _copy,
}
