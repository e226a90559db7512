"""
Values as plain data, such as JSON holds, and back by the types of their fields.

What is read makes values of the types that the reader asks for, and nothing else: data names no
class and no function, so its author can make nothing run. Data of another form is refused.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from functools import cache, cached_property
from types import NoneType, UnionType
from typing import (
    Any,
    Generic,
    TypeGuard,
    TypeVar,
    Union,
    cast,
    get_args,
    get_origin,
    get_type_hints,
)

from ros2cc_extract.errors import Ros2ccError

T = TypeVar('T')
Function = Callable[[Any], Any]

_LEAVES: Mapping[Any, frozenset[type]] = {
    str: frozenset([str]),
    int: frozenset([int]),
    float: frozenset([float, int]),
    bool: frozenset([bool]),
    NoneType: frozenset([NoneType]),
}
"""Which plain data stands for itself; a float may have been written as an integer."""
_MAPPINGS = (Mapping, dict)
_REFUSED = (ValueError, TypeError, KeyError, AttributeError, RecursionError, Ros2ccError)


class PackingError(ValueError):
    """Data that is not of the form in which such values are written."""


class Packer(Generic[T]):
    """
    Both ways for values of one type.

    :param kind: a class of ``_LEAVES``, an enumeration, a dataclass, or a tuple, mapping or union
        of such. Fields that are not compared do not belong to a value, and stay behind.
    """

    def __init__(self, kind: Any) -> None:
        self._kind = kind

    @cached_property
    def _ways(self) -> tuple[Function, Function]:
        # Not before there is something to pack: looking into classes takes milliseconds.
        return _both_ways(self._kind)

    def pack(self, value: T) -> Any:
        """
        Give a value as plain data.

        :raises TypeError: when there is something in it that no data can say, as a function.
        """
        return self._ways[0](value)

    def unpack(self, data: Any) -> T:
        """
        Make the value that ``data`` says.

        :raises PackingError: when it says none of this type.
        """
        try:
            value: T = self._ways[1](data)
        except PackingError:
            raise
        except _REFUSED as error:
            raise PackingError(repr(error)) from None
        return value


@cache
def _both_ways(kind: Any) -> tuple[Function, Function]:
    """The two functions for values of a type that are more than leaves of their own."""
    origin, arguments = get_origin(kind), get_args(kind)
    if kind in _LEAVES:
        return _same, _checked(_LEAVES[kind])
    if origin in (Union, UnionType):
        return _of_union(arguments)
    if origin is tuple:
        return _of_tuple(arguments)
    if origin in _MAPPINGS:
        return _of_mapping(*arguments)
    if _is_class(kind) and issubclass(kind, Enum):
        return _of_enumeration(kind)
    if _is_class(kind) and is_dataclass(kind):
        return _of_dataclass(kind)
    return _nothing, _nothing


def _same(value: Any) -> Any:
    return value


def _nothing(value: Any) -> Any:
    raise TypeError(f'{type(value).__name__} is not plain data')


def _checked(leaves: frozenset[type]) -> Function:
    def read(data: Any) -> Any:
        if type(data) not in leaves:
            raise PackingError(f'{type(data).__name__} stands where it cannot')
        return data

    return read


def _of_union(kinds: tuple[Any, ...]) -> tuple[Function, Function]:
    """
    A kind is recognised by its class, and its data by their form.

    :raises TypeError: when two of the kinds have data of one form.
    """
    leaves = _leaves_of(kinds)
    packers: dict[type, Function] = {}
    readers: dict[type, Function] = {}
    for kind in kinds:
        packed, read = _both_ways(kind)
        if kind in _LEAVES or packed is _nothing:
            continue
        form = _form_of(kind)
        if form in readers or form in leaves:
            raise TypeError(f'of {kinds} more than one is packed as {form.__name__}')
        packers[get_origin(kind) or kind] = packed
        readers[form] = read

    def pack(value: Any) -> Any:
        return value if type(value) in leaves else packers.get(type(value), _nothing)(value)

    def unpack(data: Any) -> Any:
        return data if type(data) in leaves else readers.get(type(data), _nothing)(data)

    return pack, unpack


def _leaves_of(kinds: tuple[Any, ...]) -> frozenset[type]:
    return frozenset().union(*(_LEAVES.get(kind, ()) for kind in kinds))


def _form_of(kind: Any) -> type:
    if _is_class(kind) and issubclass(kind, Enum):
        return str
    named = get_origin(kind) in _MAPPINGS and get_args(kind)[0] is str
    return dict if _is_class(kind) or named else list


def _is_class(kind: Any) -> TypeGuard[type[Any]]:
    """CPython 3.10 calls ``tuple[int, ...]`` a class too."""
    return isinstance(kind, type) and get_origin(kind) is None


def _of_tuple(kinds: tuple[Any, ...]) -> tuple[Function, Function]:
    if len(kinds) == 2 and kinds[1] is ...:
        return _of_row(kinds[0])
    each = [_both_ways(kind) for kind in kinds]

    def packed(value: Any) -> Any:
        return [pack(part) for (pack, _), part in zip(each, value, strict=True)]

    def read(data: Any) -> Any:
        rows = zip(each, _as_list(data), strict=True)
        return tuple([unpack(part) for (_, unpack), part in rows])

    return packed, read


def _of_row(kind: Any) -> tuple[Function, Function]:
    pack, unpack = _both_ways(kind)
    leaves = _LEAVES.get(kind, frozenset())

    def packed(value: Any) -> Any:
        return value if leaves else [pack(part) for part in value]

    def read(data: Any) -> Any:
        parts = _as_list(data)
        if leaves and leaves.issuperset(map(type, parts)):
            return tuple(parts)
        return tuple([unpack(part) for part in parts])

    return packed, read


def _as_list(data: Any) -> list[Any]:
    if type(data) not in (list, tuple):
        raise PackingError(f'{type(data).__name__} stands where a list should')
    return cast(list[Any], data)


def _of_mapping(key: Any, value: Any) -> tuple[Function, Function]:
    """As rows of key and value where the keys are not texts: JSON has no others."""
    if key is not str:
        packed, read = _of_row(tuple[key, value])
        return (lambda found: packed(found.items())), (lambda data: dict(read(data)))
    pack, unpack = _both_ways(value)
    leaves = _leaves_in(value)

    def read_named(data: Any) -> Any:
        if leaves.issuperset(map(type, data.values())):
            return data
        return {name: unpack(each) for name, each in data.items()}

    return (lambda found: {name: pack(each) for name, each in found.items()}), read_named


def _of_enumeration(kind: type[Enum]) -> tuple[Function, Function]:
    members = {member.value: member for member in kind}
    return (lambda member: member.value), members.__getitem__


def _of_dataclass(kind: type[Any]) -> tuple[Function, Function]:
    """By names, without the fields that are at their default, or ``None``."""
    hints = get_type_hints(kind)
    own = {field.name: field for field in fields(kind)}
    kept = {name: _both_ways(hints[name]) for name, field in own.items() if field.compare}
    leaves_of = {name: _leaves_in(hints[name]) for name in own}
    defaults = {name: None for name in own if NoneType in leaves_of[name]} | {
        name: field.default for name, field in own.items() if field.default is not MISSING
    }
    writers = [(name, defaults.get(name, MISSING), pack) for name, (pack, _) in kept.items()]
    readers = {name: (leaves_of[name], unpack) for name, (_, unpack) in kept.items()}
    checks = getattr(kind, '__post_init__', _same)

    def packed(value: Any) -> Any:
        if type(value) is not kind:
            raise TypeError(f'{type(value).__name__} stands where {kind.__name__} should')
        found = value.__dict__
        return {n: pack(found[n]) for n, default, pack in writers if found[n] is not default}

    def read(data: Any) -> Any:
        found = defaults | data
        for name, each in data.items():
            leaves, unpack = readers[name]
            if type(each) not in leaves:
                found[name] = unpack(each)
        if len(found) != len(own):
            raise PackingError(f'a field of {kind.__name__} is missing')
        value = object.__new__(kind)
        # As unpickling does: a frozen class lets no code set one field after the other.
        object.__setattr__(value, '__dict__', found)
        checks(value)
        return value

    return packed, read


def _leaves_in(kind: Any) -> frozenset[type]:
    """What needs no function to be read: most fields are texts and numbers."""
    kinds = get_args(kind) if get_origin(kind) in (Union, UnionType) else (kind,)
    return _leaves_of(kinds)
