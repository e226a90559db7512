"""``functools.partialmethod``: a method of which some arguments are given."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.values.values import Partial


class PartialMethod(Partial):
    """Stands in a class; an object has a ``Partial`` of its own method."""

    __slots__ = ()
