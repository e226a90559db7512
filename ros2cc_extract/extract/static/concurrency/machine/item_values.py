"""What is put into a queue, as far as the tests of a loop may ask for it that takes it out."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.static.concurrency.machine.loop_formulas import UNKNOWN, LoopTest
from ros2cc_extract.extract.static.python.values.containers import Mapping, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    OF_CALLBACK,
    Const,
    Instance,
    Mystery,
    Value,
    options_of,
)
from ros2cc_extract.light_dataclasses import dataclass

ITEM = 'the item'
"""The name of an item in the formula of a test; its parts have the texts of their keys."""

_Known = dict[tuple[str, str | None], object]


@dataclass(frozen=True, eq=False)
class Thing:
    """An object in an item, of which only the identity is known, or that it is not ``None``."""

    value: Value

    def __bool__(self) -> bool:
        raise TypeError('whether an object is true is not known')

    def is_for_sure(self, other: Thing) -> bool:
        """Whether this is ``other``; raises ``TypeError`` where that is not known."""
        if not (isinstance(self.value, Instance) and isinstance(other.value, Instance)):
            raise TypeError('whether these are one thing is not known')
        return self.value is other.value


def ends(tests: tuple[LoopTest, ...], item: Value | None) -> bool | None:
    """Whether a loop with ``tests`` ends when it has taken ``item``; ``None`` if it may."""
    found = {_ends(tests, option) for option in options_of(item)} if item is not None else {None}
    return found.pop() if len(found) == 1 else None


def _ends(tests: tuple[LoopTest, ...], item: Value) -> bool | None:
    known = dict(_parts(item))
    results = [_leaves(test, known) for test in tests]
    return True if True in results else None if None in results else False


def _leaves(test: LoopTest, known: _Known) -> bool | None:
    if test.stays_if is None:
        return True
    try:
        result = test.formula.result(known, {})
        return None if result is UNKNOWN else bool(result) is not test.stays_if
    except TypeError:
        return None


def _parts(item: Value) -> Iterator[tuple[tuple[str, str | None], object]]:
    whole = _known(item)
    if whole is not UNKNOWN:
        yield (ITEM, None), whole
    for key, part in _items(item):
        options = options_of(part)
        value = _known(options[0]) if len(options) == 1 else UNKNOWN
        if value is not UNKNOWN:
            yield (ITEM, key), value


def _items(item: Value) -> Iterator[tuple[str, Value]]:
    if isinstance(item, Sequence) and item.rest is None:
        yield from ((repr(number), part) for number, part in enumerate(item.items))
    elif isinstance(item, Mapping):
        entries = item.entries.items()
        yield from ((repr(key.value), part) for key, part in entries if isinstance(key, Const))


def _known(value: Value) -> object:
    if isinstance(value, Const):
        return value.value
    if isinstance(value, Mystery):
        # The fields of a message have types of their own, and none of these is that of None.
        is_given = value.unknown.reason == OF_CALLBACK and '(' not in value.text
        return Thing(value) if is_given else UNKNOWN
    return Thing(value)
