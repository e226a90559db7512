"""Names of callbacks, groups and nodes in a unit: readable, unique, the same on every run."""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.identifiers import mend


class Names:
    """The names of one unit; each is given once."""

    def __init__(self) -> None:
        self._taken: set[str] = set()
        self._next: dict[str, int] = {}

    def __contains__(self, name: str) -> bool:
        return name in self._taken

    def take(self, label: str) -> str:
        """A usable name from ``label``, numbered when that is taken."""
        name = base = mend(label)
        number = self._next.get(base, 2)
        while name in self._taken:
            name, number = f'{base}_{number}', number + 1
        self._next[base] = number
        self._taken.add(name)
        return name


@dataclass(frozen=True)
class Wanted:
    """A name that is wanted, and what distinguishes its owner from others of that name."""

    label: str
    key: str | None
    node: str | None


def unique_names(wanted: Sequence[Wanted], taken: Names) -> list[str]:
    """Give each its label where that is free, else prefixed by key, node, or numbered."""
    members: dict[str, list[int]] = {}
    for index, entry in enumerate(wanted):
        members.setdefault(mend(entry.label), []).append(index)
    alone = {name for name, indices in members.items() if len(indices) == 1 and name not in taken}
    names = {indices[0]: taken.take(name) for name, indices in members.items() if name in alone}
    for name, indices in members.items():
        if name not in alone:
            candidates = _distinguished(wanted, indices, taken)
            for index, candidate in zip(indices, candidates, strict=True):
                names[index] = taken.take(candidate)
    return [names[index] for index in range(len(wanted))]


def _distinguished(wanted: Sequence[Wanted], members: list[int], taken: Names) -> list[str]:
    entries = [wanted[index] for index in members]
    for parts in (('key',), ('node',), ('node', 'key')):
        names = [_prefixed(entry, parts) for entry in entries]
        if len(parts) == 1 and None in names:
            continue
        mended = [mend(name or entry.label) for name, entry in zip(names, entries, strict=True)]
        if len(set(mended)) == len(mended) and not any(name in taken for name in mended):
            return mended
    return [_best_prefixed(entry, len(entries)) for entry in entries]


def _prefixed(entry: Wanted, parts: Sequence[str]) -> str | None:
    texts = [text for part in parts if (text := getattr(entry, part)) is not None]
    return '_'.join([*texts, entry.label]) if texts else None


def _best_prefixed(entry: Wanted, number: int) -> str:
    return _prefixed(entry, ('key',)) or entry.label if number > 1 else entry.label
