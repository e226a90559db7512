"""
Releases of rclpy, and the distributions that ship them.

The major number of a release is the line of one distribution. What is asked of a release may also
be asked of a distribution, by its name, or of all that are supported, by ``None``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from ros2cc_extract.light_dataclasses import dataclass

Release = tuple[int, int, int]
_RELEASE = re.compile(r'(\d+)\.(\d+)\.(\d+)')


@dataclass(frozen=True, kw_only=True)
class Line:
    """
    The releases of one distribution.

    :param distro: as ``ROS_DISTRO`` has it.
    :param oldest: the first that is supported.
    :param newest: the newest that was looked at; a later one is judged as this one.
    :param python: the Python that the distribution runs.
    """

    distro: str
    major: int
    oldest: Release
    newest: Release
    python: str


# Newest: of Jazzy, Kilted, Lyrical and Rolling the sources; of Humble the change log.
LINES = (
    Line(distro='humble', major=3, oldest=(3, 3, 15), newest=(3, 3, 22), python='3.10'),
    Line(distro='jazzy', major=7, oldest=(7, 1, 6), newest=(7, 1, 11), python='3.12'),
    Line(distro='kilted', major=9, oldest=(9, 1, 2), newest=(9, 1, 5), python='3.12'),
    Line(distro='lyrical', major=10, oldest=(10, 0, 10), newest=(10, 0, 10), python='3.14'),
    Line(distro='rolling', major=11, oldest=(11, 0, 0), newest=(11, 0, 1), python='3.14'),
)
BY_DISTRO = {line.distro: line for line in LINES}
_BY_MAJOR = {line.major: line for line in LINES}
_SUPPORTED = ', '.join(f'{line.distro.title()} {line.major}' for line in LINES)


def release_of(version: str | None) -> Release | None:
    """The numbers of ``7.1.6`` or ``7.1.6-1jammy``; ``None`` for what is no release."""
    found = _RELEASE.match(version or '')
    return (int(found[1]), int(found[2]), int(found[3])) if found else None


def text_of(release: Release) -> str:
    """Write a release as rclpy does."""
    return '.'.join(map(str, release))


def line_of(version: str | None) -> Line | None:
    """The line of a release or of a distribution; ``None`` for one that is not known."""
    release = release_of(version)
    if release is not None:
        return _BY_MAJOR.get(release[0])
    return BY_DISTRO.get(version or '')


def lines_of(version: str | None) -> tuple[Line, ...]:
    """The lines that are asked: all for ``None``."""
    if version is None:
        return LINES
    line = line_of(version)
    return () if line is None else (line,)


def newest_of(version: str) -> str:
    """The newest known release of a distribution; a release stands for itself."""
    line = BY_DISTRO.get(version)
    return version if line is None else text_of(line.newest)


def judged_as(version: str) -> str | None:
    """
    What an unexamined release is judged as, for the reader.

    :return: ``None`` for one that was, or that is no release.
    """
    release = release_of(version)
    if release is None:
        return None
    line, known = _BY_MAJOR.get(release[0]), max(_BY_MAJOR)
    if line is not None and release <= line.newest:
        return None
    words = f'rclpy {text_of(release)} is judged as'
    if line is None and release[0] < known:
        return f'{words} a release of a line that is not supported; those are {_SUPPORTED}'
    newest = (line or _BY_MAJOR[known]).newest
    return f'{words} {text_of(newest)}, the newest known'


def representatives(version: str | None, changes: Iterable[Release]) -> Iterator[Release]:
    """
    One release for each stretch of the lines that are asked in which nothing changes.

    :param changes: the releases that change anything.
    """
    known = tuple(changes)
    for line in lines_of(version):
        yield line.oldest
        yield from sorted({each for each in known if _is_within(each, line)})


def _is_within(release: Release, line: Line) -> bool:
    return release[0] == line.major and line.oldest < release <= line.newest
