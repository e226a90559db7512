"""What a handler has caught: of which classes it is for certain, ``except OSError as error:``."""

from __future__ import annotations

import builtins
from collections.abc import Iterable

from ros2cc_extract.extract.static.python.values.values import Library, Mystery, Value
from ros2cc_extract.source_locations import Place, Unknown


class Caught(Mystery):
    """
    An exception.

    :param kinds: of which one it is at least, as the handler has them.
    """

    __slots__ = ('kinds',)

    def __init__(self, place: Place, text: str, kinds: Iterable[str]) -> None:
        super().__init__(Unknown('a caught exception', place), text)
        self.kinds = tuple(kinds)

    def is_surely(self, cls: Value) -> bool:
        """Whether it is one of ``cls``, by the classes of Python itself."""
        name = cls.name if isinstance(cls, Library) else ''
        wanted = _exception(name.removeprefix('builtins.'))
        known = [_exception(kind) for kind in self.kinds]
        return wanted is not None and all(
            kind is not None and issubclass(kind, wanted) for kind in known
        )


def _exception(name: str) -> type[BaseException] | None:
    found = getattr(builtins, name, None)
    return found if isinstance(found, type) and issubclass(found, BaseException) else None
