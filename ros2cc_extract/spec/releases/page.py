"""The page of the documentation that shows the table of behaviours."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.lines import LINES, Line, Release, text_of
from ros2cc_extract.spec.releases.table import PYTHON, RCLPY

_HEAD = """\
# Releases

What differs between the releases of rclpy that are supported, and between those of Python. Models
and rules read the same table (`ros2cc_extract/spec/releases/table.py`), from which this page is
written. A release newer than all that were looked at is judged as the newest of its distribution.

`check` judges for all supported releases. A finding that only some of them have says on which, and
a promise is kept only where it is kept on all. `--distro jazzy` or `--rclpy 7.1.6` judges for one.
`verify --profile rclpy` prints a table for each group of releases under which the unit behaves
alike. `model` and a sweep have one model: what not all releases have, it takes none to have.
`conform` judges by the release that the trace names. `upgrade --from humble --to lyrical PATH`
lists what changes for your nodes, certain or under a condition that the line names. It was
compared with 43 whole nodes on 3.3.21, 7.1.6, 7.1.11, 9.1.2, 9.1.5, 10.0.10 and 11.0.0
(`tests/releases/upgrades`): it names each of the 33 that some two of these releases run
differently, at its line, and nothing else.

A release that is not in the table is reported: *rclpy 12.3.0 is judged as 11.0.1, the newest
known*.
"""


def page() -> str:
    """Write the page."""
    parts = [_HEAD, *_picture(), *_details('rclpy', RCLPY), *_details('Python', PYTHON)]
    return '\n'.join(parts)


def _picture() -> Iterator[str]:
    yield '## Behaviour by release\n'
    heads = [f'{line.distro.capitalize()} {line.major}' for line in LINES]
    yield f'| | {" | ".join(heads)} |'
    yield '|---' * (len(LINES) + 1) + '|'
    for row in RCLPY:
        cells = [_cell(row, line) for line in LINES]
        yield f'| [{row.concerns}](#{row.name}) | {" | ".join(cells)} |'
    yield (
        '\n*yes*: as the second sentence of the row says, from the release on that is named, '
        'or in all that are supported.\n'
    )


def _cell(row: Behaviour, line: Line) -> str:
    holds = row.holds(line.distro)
    if holds is not None:
        return 'yes' if holds else 'no'
    since, until = row.since.get(line.major), row.until.get(line.major)
    words = [f'from {text_of(since)} on'] if since and since > line.oldest else []
    return ', '.join([*words, *([f'before {text_of(until)}'] if until else [])]) or 'not known'


def _details(what: str, rows: Iterable[Behaviour]) -> Iterator[str]:
    yield f'## Rows of {what}\n'
    for row in rows:
        ends = f', before {_releases(row.until)}' if row.until else ''
        yield f'### {row.name}\n'
        yield f'{_sentence(row.concerns)}\n'
        yield f'- Before: {row.without}.'
        yield f'- From {_releases(row.since)} on{ends}: {row.having}.'
        yield f'- Source: {row.source}.'
        yield f'- Seen: {row.observed}.\n'


def _sentence(text: str) -> str:
    return f'{text[0].upper()}{text[1:]}.'


def _releases(releases: Mapping[int, Release]) -> str:
    return ', '.join(text_of(each) for line, each in releases.items() if line == each[0])
