"""Which of the things a program makes exclude each other: branches of one statement."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from itertools import takewhile

from ros2cc_extract.extract.static.python.values.values import Path
from ros2cc_extract.source_locations import Place

Mark = tuple[str | None, int | None]
"""Equal first parts stand for branches of one statement, of which only one is taken."""

NO_MARK: Mark = (None, None)

IN_A_CALLBACK = -2
"""Step of a path that a callback takes, each time it runs."""


class Branches:
    """
    The branching statements on whose branches something is made.

    Those inside of a callback do not count: it may take one now, and another when it runs again.
    """

    def __init__(self, paths: Iterable[Path]) -> None:
        self._taken: dict[Place, set[int]] = defaultdict(set)
        for path in paths:
            for place, branch in _taken_once(path):
                if branch >= 0:
                    self._taken[place].add(branch)

    def mark_of(self, path: Path) -> Mark:
        """The outermost statement on another branch of which something is made as well."""
        for place, branch in _taken_once(path):
            if branch >= 0 and len(self._taken[place]) > 1:
                return f'{place.file}:{place.line}', branch
        return NO_MARK


def _taken_once(path: Path) -> Path:
    return tuple(takewhile(lambda step: step[1] != IN_A_CALLBACK, path))


def is_behind(first: Path, last: Path) -> bool:
    """Whether what stood on ``first`` has happened on every way to what ``last`` leads to."""
    return last[: len(first)] == first


def beyond(path: Path, prefix: Path) -> Path:
    """The part of ``path`` that ``prefix`` does not share."""
    return tuple(step for step in path if step not in prefix)


def shared(paths: Sequence[Path]) -> Path:
    """The steps that all of ``paths`` have."""
    return tuple(step for step in paths[0] if all(step in path for path in paths[1:]))


def exclusive(one: Path, other: Path) -> bool:
    """Whether two paths cannot both be taken: different branches of one statement."""
    branches = {place: index for place, index in one if index >= 0}
    return any(index >= 0 and branches.get(place, index) != index for place, index in other)
