"""What a row of the table of behaviours is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.releases.lines import Release, release_of, representatives


@dataclass(frozen=True, kw_only=True, eq=False)
class Behaviour:
    """
    A behaviour that some releases have, and others do not.

    A change reaches each line in a release of its own. Lines before the earliest that are named
    lack it, lines after the latest have it; of those between nothing is known.

    :param name: of the switch.
    :param concerns: what it is about, in some words.
    :param without: what releases do that lack it.
    :param having: what releases do that have it.
    :param since: the first release that has it, by line.
    :param until: the first that lacks it again, by line.
    :param source: pull request and file that say so.
    :param observed: what shows it, and where that was seen.
    """

    name: str
    concerns: str
    without: str
    having: str
    since: Mapping[int, Release]
    until: Mapping[int, Release] = field(default_factory=dict)
    source: str
    observed: str

    def holds(self, version: str | None) -> bool | None:
        """
        Return whether a release behaves so.

        :param version: a release, a distribution, or ``None`` for all that are supported.
        :return: ``None`` where releases of it differ, or nothing is known.
        """
        release = release_of(version)
        if release is not None:
            return self._holds_in(release)
        found = {self._holds_in(each) for each in representatives(version, self.changes())}
        return found.pop() if len(found) == 1 else None

    def changes(self) -> Iterator[Release]:
        """Give the releases that change something, of all lines."""
        yield from self.since.values()
        yield from self.until.values()

    def _holds_in(self, release: Release) -> bool | None:
        return False if self._is_over(release) else _has_come(release, self.since)

    def _is_over(self, release: Release) -> bool:
        """A line without a known end goes on."""
        if not self.until:
            return False
        end = self.until.get(release[0])
        return release[0] > max(self.until) if end is None else release >= end

    def differs(self, old: str | None, new: str | None) -> bool:
        """Whether one has it and the other has not, as far as that is known."""
        before, after = self.holds(old), self.holds(new)
        return before is not after and None not in (before, after)

    def words_for(self, version: str | None) -> str:
        """What a release does, in words."""
        holds = self.holds(version)
        if holds is None:
            return f'{self.without}, or {self.having}'
        return self.having if holds else self.without


def _has_come(release: Release, first: Mapping[int, Release]) -> bool | None:
    line = release[0]
    if line in first:
        return release >= first[line]
    if line > max(first):
        return True
    return False if line < min(first) else None
