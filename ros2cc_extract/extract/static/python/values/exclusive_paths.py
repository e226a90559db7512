"""Which of the things a program makes exclude each other: branches of one statement."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from itertools import dropwhile, takewhile

from ros2cc_extract.extract.static.python.values.values import Path
from ros2cc_extract.source_locations import Place

Mark = tuple[str | None, int | None]
"""Equal first parts stand for branches of one statement, of which only one is taken."""

_Choices = tuple[int, ...]

NO_MARK: Mark = (None, None)

IN_A_CALLBACK = -2
"""Step of a path that a callback takes, each time it runs."""


class Branches:
    """
    The branching statements on whose branches something is made.

    Those inside of a callback do not count: it may take one now, and another when it runs again.
    """

    def __init__(self, paths: Iterable[Path]) -> None:
        self._paths = [_chosen(path) for path in paths]
        self._taken: dict[Place, set[int]] = defaultdict(set)
        for place, branch in (step for path in self._paths for step in path):
            self._taken[place].add(branch)
        self._numbers: dict[Place, dict[_Choices, int]] = {}

    def mark_of(self, path: Path) -> Mark:
        """
        The outermost statement on another branch of which something is made as well.

        Where another statement divides all that is made on one branch, each of its branches
        counts as one of the outermost statement.
        """
        steps = _chosen(path)
        for index, (place, branch) in enumerate(steps):
            if len(self._taken[place]) > 1:
                choices = self._choices(steps[index:])
                number = branch if len(choices) == 1 else self._number(place, choices)
                return f'{place.file}:{place.line}', number
        return NO_MARK

    def _choices(self, steps: Path) -> _Choices:
        """The branches from the first statement on, as long as one divides what is left."""
        chosen, peers = [steps[0][1]], _on(self._paths, steps[0])
        for place, branch in steps[1:]:
            taken = {dict(path).get(place) for path in peers}
            if None not in taken and len(taken) > 1:
                chosen.append(branch)
                peers = _on(peers, (place, branch))
        return tuple(chosen)

    def _number(self, place: Place, choices: _Choices) -> int:
        """A number for several branches, one in the other, that no single branch has."""
        if place not in self._numbers:
            behind = (dropwhile(lambda step: step[0] != place, path) for path in self._paths)
            found = {self._choices(steps) for steps in map(tuple, behind) if steps}
            first = 1 + max(self._taken[place])
            several = sorted(each for each in found if len(each) > 1)
            self._numbers[place] = {each: first + at for at, each in enumerate(several)}
        return self._numbers[place][choices]


def _on(paths: Iterable[Path], step: tuple[Place, int]) -> list[Path]:
    return [path for path in paths if step in path]


def _chosen(path: Path) -> Path:
    """The branches that were taken once."""
    return tuple(step for step in _taken_once(path) if step[1] >= 0)


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
