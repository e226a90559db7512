"""Query files (``.q``) and the texts of queries: comments, continuations, line numbers."""

from __future__ import annotations

import re

from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

_COMMENT = re.compile(r'/\*.*?\*/|//[^\n]*', re.DOTALL)


@dataclass(frozen=True)
class Query:
    """
    One query.

    :param formula: its text in one line, without comments.
    :param comment: what was written above it, or in the model's comment field.
    """

    formula: str
    comment: str
    place: Place | None


def clean(text: str) -> str:
    """Return a formula in one line without comments."""
    return ' '.join(_COMMENT.sub(' ', text).replace('\\\n', ' ').split())


def first_line(text: str, line: int) -> int:
    """Return the line of the first character of a formula."""
    blank = _COMMENT.sub(lambda match: re.sub(r'\S', ' ', match[0]), text)
    return line + blank[: len(blank) - len(blank.lstrip())].count('\n')


def read_query_file(text: str, name: str) -> tuple[Query, ...]:
    """
    Split a query file: one query per line; a backslash or an open bracket continues it.

    :raises ModelFormatError: a comment that is not closed, or no query at all.
    """
    if '\0' in text:
        raise ModelFormatError('the file is binary, not text', Place(name), 'give a .q file')
    queries: list[Query] = []
    comments: list[str] = []
    pending: list[str] = []
    start, opened, in_comment = 0, 0, False
    for number, raw in enumerate(text.split('\n'), 1):
        line, spoken, in_comment = _without_comments(raw, in_comment)
        comments += spoken
        if not pending:
            start = number
        is_continued = line.rstrip().endswith('\\')
        pending.append(line.rstrip().removesuffix('\\') + ' ')
        opened += line.count('(') - line.count(')')
        if is_continued or opened > 0:
            continue
        formula = clean(''.join(pending))
        if formula:
            queries.append(Query(formula, ' '.join(comments), Place(name, start)))
            comments = []
        pending, opened = [], 0
    if in_comment or ''.join(pending).strip():
        what = 'a comment is not closed' if in_comment else 'the last query is not complete'
        raise ModelFormatError(what, Place(name, start), 'close it')
    if not queries:
        raise ModelFormatError('the file has no query', Place(name), 'write one query per line')
    return tuple(queries)


def _without_comments(line: str, in_comment: bool) -> tuple[str, list[str], bool]:
    """Return what is left of a line, what its comments say, and whether one stays open."""
    kept, spoken = '', []
    while line:
        if in_comment:
            inner, closed, line = line.partition('*/')
            spoken.append(inner.strip())
            in_comment = not closed
            continue
        opening = re.search(r'/\*|//', line)
        if opening is None:
            kept, line = kept + line, ''
        elif opening[0] == '//':
            spoken.append(line[opening.end() :].strip())
            kept, line = kept + line[: opening.start()], ''
        else:
            kept += line[: opening.start()] + ' '
            line, in_comment = line[opening.end() :], True
    return kept, [text for text in spoken if text], in_comment
