"""Names of callbacks in a unit: readable, unique, the same on every run, whatever the source."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from ros2cc_extract.spec.identifiers import mend


@dataclass(frozen=True)
class Wanted:
    """A name somebody would like to have, and what tells him from others of that name."""

    label: str
    key: str | None
    node: str | None


def unique_names(wanted: Sequence[Wanted], taken: set[str]) -> list[str]:
    """Give each its label where that is free, else prefixed by key, node, or numbered."""
    uses = Counter(mend(entry.label) for entry in wanted)
    names: list[str | None] = []
    for entry in wanted:
        name = mend(entry.label)
        names.append(name if uses[name] == 1 and name not in taken else None)
    taken.update(name for name in names if name)
    for label in dict.fromkeys(mend(e.label) for e, n in zip(wanted, names, strict=True) if not n):
        members = [i for i, e in enumerate(wanted) if mend(e.label) == label]
        for index, name in zip(members, _tell_apart(wanted, members, taken), strict=True):
            names[index] = mend(name, taken)
            taken.add(names[index] or '')
    return [name or '' for name in names]


def _tell_apart(wanted: Sequence[Wanted], members: list[int], taken: set[str]) -> list[str]:
    entries = [wanted[index] for index in members]
    for parts in (('key',), ('node',), ('node', 'key')):
        names = [_prefixed(entry, parts) for entry in entries]
        if None in names:
            continue
        mended = [mend(name or '') for name in names]
        if len(set(mended)) == len(mended) and not taken & set(mended):
            return mended
    return [_best_prefixed(entry, len(entries)) for entry in entries]


def _prefixed(entry: Wanted, parts: Sequence[str]) -> str | None:
    texts = [getattr(entry, part) for part in parts]
    return None if None in texts else '_'.join([*texts, entry.label])


def _best_prefixed(entry: Wanted, number: int) -> str:
    return _prefixed(entry, ('key',)) or entry.label if number > 1 else entry.label
