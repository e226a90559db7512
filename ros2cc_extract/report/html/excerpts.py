"""
Source lines that the page shows, each stored once.

A place is a link to its file at the end of the page. The script copies the lines from there to the
link; a browser without scripts follows it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape
from itertools import groupby

from ros2cc_extract.report.html.parts import folded, span, tag
from ros2cc_extract.source_locations import Place

AROUND = 2
"""Lines before and behind the place of a finding."""


class Excerpts:
    """
    Lines of sources, collected while the page is written.

    :param sources: text of the source files, by the path that places name.
    """

    def __init__(self, sources: Mapping[str, str]) -> None:
        self._sources = sources
        self._lines: dict[str, list[str]] = {}
        self._shown: dict[str, set[int]] = {}
        self._numbers: dict[str, int] = {}

    def link(self, place: Place, around: int = 0) -> str:
        """Write a place, with its line and those around it; without where it is not at hand."""
        lines = self._lines_of(place.file)
        if not 1 <= place.line <= len(lines):
            return span('place', str(place))
        shown = self._shown.setdefault(place.file, set())
        shown.update(range(max(place.line - around, 1), min(place.line + around, len(lines)) + 1))
        number = self._numbers.setdefault(place.file, len(self._numbers))
        return tag(
            'a',
            escape(str(place)),
            class_='place',
            href=f'#source-{number}',
            data_line=str(place.line),
            **({'data_around': str(around)} if around else {}),
        )

    def section(self) -> str:
        """Write the lines of all files that were linked."""
        files = ''.join(
            folded(escape(file), *self._blocks(file, shown), class_='file', id=f'source-{number}')
            for number, (file, shown) in enumerate(self._shown.items())
        )
        return tag('section', tag('h2', 'Sources'), files, id='sources') if files else ''

    def _blocks(self, file: str, shown: set[int]) -> Iterator[str]:
        """Write lines that follow each other as one block."""
        numbered = enumerate(sorted(shown))
        for _, block in groupby(numbered, key=lambda pair: pair[1] - pair[0]):
            numbers = [number for _, number in block]
            text = '\n'.join(self._lines[file][n - 1].expandtabs(4) for n in numbers)
            # HTML takes a line end at the begin of a block away, which may be a line of its own.
            yield tag(
                'pre', '\n', escape(text), class_='source', data_from=str(numbers[0]), tabindex='0'
            )

    def _lines_of(self, file: str) -> list[str]:
        if file not in self._lines:
            self._lines[file] = self._sources.get(file, '').splitlines()
        return self._lines[file]
