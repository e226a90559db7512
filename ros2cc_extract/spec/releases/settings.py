"""Which supported releases are alike in some behaviours: one of them stands for all."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from functools import cache
from itertools import groupby, zip_longest

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.lines import (
    LINES,
    Release,
    representatives,
    text_of,
)


@dataclass(frozen=True)
class Setting:
    """
    Releases that are alike.

    :param values: whether they have each of the behaviours; ``None`` where that is not known.
    :param releases: the first of each stretch of releases, in the order of the lines.
    """

    values: tuple[bool | None, ...]
    releases: tuple[Release, ...]

    @property
    def release(self) -> str:
        """One of them, for which a unit is judged."""
        return text_of(self.releases[-1])


@cache
def settings(rows: tuple[Behaviour, ...]) -> tuple[Setting, ...]:
    """
    Give each setting of some behaviours that a supported release has.

    The first is the one that is meant where no release is named: what not all of them have, none
    has. It stands first even where no supported release has it.
    """
    found: dict[tuple[bool | None, ...], list[Release]] = {}
    found[tuple(row.holds(None) is True for row in rows)] = []
    for release in _stretches(rows):
        values = tuple(row.holds(text_of(release)) for row in rows)
        found.setdefault(values, []).append(release)
    return tuple(Setting(values, tuple(releases)) for values, releases in found.items())


def where(releases: Collection[Release], rows: Sequence[Behaviour]) -> str:
    """
    Name releases for a reader: ``Humble, Jazzy before 7.1.9``.

    :param releases: the first of each stretch that is meant.
    """
    return ', '.join(_named(releases, rows))


def _named(releases: Collection[Release], rows: Sequence[Behaviour]) -> Iterator[str]:
    for line in LINES:
        distro = line.distro.title()
        stretches = [each for each in _stretches(rows) if each[0] == line.major]
        if all(each in releases for each in stretches):
            yield distro
            continue
        runs = groupby(stretches, key=releases.__contains__)
        begins = [(next(run), is_meant) for is_meant, run in runs]
        for (begin, is_meant), end in zip_longest(begins, [each for each, _ in begins[1:]]):
            if is_meant:
                yield _stretch(distro, None if begin == stretches[0] else begin, end)


def _stretch(distro: str, begin: Release | None, end: Release | None) -> str:
    if begin and end:
        return f'{distro} from {text_of(begin)} and before {text_of(end)}'
    if begin:
        return f'{distro} from {text_of(begin)} on'
    return f'{distro} before {text_of(end)}' if end else distro


def _stretches(rows: Sequence[Behaviour]) -> Iterator[Release]:
    changes = [release for row in rows for release in row.changes()]
    return representatives(None, changes)
