"""Small pieces of HTML text; everything that comes from outside is escaped here."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from ros2cc_extract.diagnostics import Severity

SEVERITY_WORDS = {Severity.ERROR: 'error', Severity.WARNING: 'warning', Severity.NOTE: 'note'}


def tag(name: str, *content: str, **attributes: str) -> str:
    """Write an element around finished HTML; ``class_`` and ``data_x`` give their attributes."""
    given = ''.join(
        f' {key.rstrip("_").replace("_", "-")}="{escape(value)}"'
        for key, value in attributes.items()
    )
    return f'<{name}{given}>{"".join(content)}</{name}>'


def folded(summary: str, *content: str, opened: bool = False, **attributes: str) -> str:
    """Write finished HTML that a click on its summary shows."""
    more = {'open': ''} if opened else {}
    return tag('details', tag('summary', summary), *content, **attributes, **more)


def span(class_: str, text: str) -> str:
    """Write text in a span."""
    return tag('span', escape(text), class_=class_)


def code(text: str) -> str:
    """Write text as code."""
    return tag('code', escape(text))


def items(contents: Iterable[str], class_: str) -> str:
    """Write a list of finished HTML; nothing when it is empty."""
    rows = ''.join(tag('li', content) for content in contents)
    return tag('ul', rows, class_=class_) if rows else ''


def prose(text: str) -> str:
    """Write help text: words between backquotes become code."""
    parts = text.split('`')
    return ''.join(code(part) if number % 2 else escape(part) for number, part in enumerate(parts))
