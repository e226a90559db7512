"""Small pieces of HTML text; everything that comes from outside is escaped here."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from html import escape

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.source_locations import Place

Sources = Mapping[str, str]
"""Text of the source files, by the path that places name."""

EXCERPT_AROUND = 2
SEVERITY_WORDS = {Severity.ERROR: 'error', Severity.WARNING: 'warning', Severity.NOTE: 'note'}


def tag(name: str, *content: str, **attributes: str) -> str:
    """Write an element around finished HTML; ``class_`` and ``data_x`` give their attributes."""
    given = ''.join(
        f' {key.rstrip("_").replace("_", "-")}="{escape(value)}"'
        for key, value in attributes.items()
    )
    return f'<{name}{given}>{"".join(content)}</{name}>'


def span(class_: str, text: str) -> str:
    """Write text in a span."""
    return tag('span', escape(text), class_=class_)


def code(text: str) -> str:
    """Write text as code."""
    return tag('code', escape(text))


def place_text(place: Place | None) -> str:
    """Write a place; nothing when there is none."""
    return span('place', str(place)) if place else ''


def items(contents: Iterable[str], class_: str) -> str:
    """Write a list of finished HTML; nothing when it is empty."""
    rows = ''.join(tag('li', content) for content in contents)
    return tag('ul', rows, class_=class_) if rows else ''


def prose(text: str) -> str:
    """Write help text: words between backquotes become code."""
    parts = text.split('`')
    return ''.join(code(part) if number % 2 else escape(part) for number, part in enumerate(parts))


def excerpt(place: Place, sources: Sources, around: int = EXCERPT_AROUND) -> str:
    """Show the lines around a place; nothing when the source is not at hand."""
    lines = sources.get(place.file, '').splitlines()
    if not 1 <= place.line <= len(lines):
        return ''
    first = max(place.line - around, 1)
    shown = lines[first - 1 : place.line + around]
    rows = ''.join(
        _source_line(number, line.expandtabs(4), number == place.line)
        for number, line in enumerate(shown, start=first)
    )
    return tag('pre', rows, class_='source', tabindex='0')


def _source_line(number: int, text: str, is_place: bool) -> str:
    row = f'{span("number", f"{number:5}")} {escape(text)}\n'
    return tag('span', row, class_='line here' if is_place else 'line')


def plural(number: int, noun: str) -> str:
    """Write ``1 file``, ``2 files``."""
    return f'{number} {noun}{"" if number == 1 else "s"}'
