"""Words for the names of a unit: as in the developer's code, and no two alike."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping

from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Activity, Callback, CallbackGroup, Spec


def display_names(spec: Spec) -> Mapping[str, str]:
    """
    Give words by name, of callbacks, activities and groups.

    Namesakes have their line with them, or else the name of the unit.
    """
    named: tuple[Callback | Activity | CallbackGroup, ...] = (
        *spec.callbacks,
        *spec.activities,
        *spec.groups,
    )
    return _distinguished((each.name, each.display_name, each.source) for each in named)


def _distinguished(entries: Iterable[tuple[str, str, Place | None]]) -> Mapping[str, str]:
    entries = list(entries)
    times = Counter(words for _, words, _ in entries)
    with_line = {name: _with_line(words, place) for name, words, place in entries}
    times_with_line = Counter(with_line.values())
    said: dict[str, str] = {}
    for name, words, _ in entries:
        if times[words] == 1:
            said[name] = words
        else:
            at = with_line[name]
            said[name] = at if times_with_line[at] == 1 else f'{words} ({name})'
    return said


def _with_line(words: str, place: Place | None) -> str:
    return words if place is None else f'{words} (line {place.line})'
