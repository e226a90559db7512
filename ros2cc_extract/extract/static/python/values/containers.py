"""Lists, tuples, sets and dictionaries as abstract values, with what is not known of them."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Function,
    Heaped,
    Instance,
    Mystery,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Unknown


class Collection(Heaped):
    """
    What lists and dictionaries share.

    Slots: ``open`` (``Unknown`` when there may be items that are not known at all) and ``many``
    (a known item -> why it stands for any number of items, or ``NONE`` where there is one and
    only its key is unknown).
    """

    __slots__ = ()

    def __init__(self, others: Unknown | None, many: dict[Value, Value] | None) -> None:
        super().__init__()
        self.slots['open'] = others
        self.slots['many'] = many or {}

    @property
    def others(self) -> Unknown | None:
        """Why there may be items that no known one stands for."""
        others = self.slots['open']
        return others if isinstance(others, Unknown) else None

    @property
    def many(self) -> dict[Value, Value]:
        """Items that stand for others too; never to be changed in place."""
        many: dict[Value, Value] = self.slots['many']
        return many

    @property
    def rest(self) -> Unknown | None:
        """Why there may be more items than the known ones, or others."""
        if self.others is not None or not self.many:
            return self.others
        whys = [option for why in self.many.values() for option in options_of(why)]
        known = next((why.unknown for why in whys if isinstance(why, Mystery)), None)
        return known or Unknown('a key could not be followed')


class Sequence(Collection):
    """
    A list, tuple, set or other ordered collection.

    Slots: ``items`` (tuple of values), and those of a collection.
    """

    __slots__ = ('kind',)

    def __init__(
        self,
        items: tuple[Value, ...],
        kind: str = 'list',
        others: Unknown | None = None,
        many: dict[Value, Value] | None = None,
    ) -> None:
        super().__init__(others, many)
        self.kind = kind
        self.slots['items'] = items

    @property
    def items(self) -> tuple[Value, ...]:
        """The known items, in order."""
        return tuple(self.slots['items'])


class Generator(Sequence):
    """
    What a generator function gives; its items are known once its body has run.

    Slots: ``taker`` (for whom it has run last), ``held`` (the locks that it keeps while it
    yields), and those of a sequence.
    """

    __slots__ = ('call', 'function')

    def __init__(self, function: Function, call: Call) -> None:
        super().__init__((), 'generator', Unknown('nothing was taken from it yet', call.place))
        self.function = function
        self.call = call


class Mapping(Collection):
    """
    A dictionary; slots: ``entries`` (key -> value), and those of a collection, by key.

    :ivar fills: reading a missing key adds it, as in ``collections.defaultdict``.
    """

    __slots__ = ('fills',)

    def __init__(
        self,
        entries: dict[Value, Value],
        others: Unknown | None = None,
        many: dict[Value, Value] | None = None,
    ) -> None:
        super().__init__(others, many)
        self.slots['entries'] = entries
        self.fills = False

    @property
    def entries(self) -> dict[Value, Value]:
        """The known entries, in order; never to be changed in place."""
        entries: dict[Value, Value] = self.slots['entries']
        return entries


class Fields(Value):
    """``owner.__dict__``: the attributes of an object by name, past its own methods for them."""

    __slots__ = ('owner',)

    def __init__(self, owner: Instance) -> None:
        self.owner = owner


def collection_class(value: Collection) -> str:
    """The Python class of a collection."""
    return value.kind if isinstance(value, Sequence) else 'dict'
