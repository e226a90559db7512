"""One self-contained page of systems: the picture of each, and its units, nothing judged."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape

from ros2cc_extract.report.html.page import page
from ros2cc_extract.report.html.parts import tag
from ros2cc_extract.report.html.runs import Runs
from ros2cc_extract.report.html.system_picture import UnitKey, system_section, unit_key
from ros2cc_extract.report.html.units import MOST_OPEN, anchor, unit_section
from ros2cc_extract.report.shared.unit_rows import Row
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.system.model import System
from ros2cc_extract.text_escaping import printable

_SEARCH = 'search units'
_MOST_NAMES = 4


def system_page(systems: Sequence[System]) -> str:
    """Write systems."""
    rows: dict[Spec, Row] = {}
    sections = []
    for number, system in enumerate(systems):
        for unit in _units(system):
            rows.setdefault(unit, Row(printable(unit), (), len(rows)))
        anchors: dict[UnitKey, str] = {
            unit_key(printable(unit)): anchor(rows[unit]) for unit in _units(system)
        }
        sections.append(system_section(system, anchors, f'system-{number}'))
    units = ''.join(
        unit_section(row, [], '', opened=len(rows) <= MOST_OPEN) for row in rows.values()
    )
    body = (_header(systems), *sections, tag('section', units, class_='units'))
    return page(''.join(body), Runs().data())


def _units(system: System) -> Iterator[Spec]:
    for process in system.processes:
        yield from process.units


def _header(systems: Sequence[System]) -> str:
    names = [printable(system.name) for system in systems]
    more = f' and {len(names) - _MOST_NAMES} more' if len(names) > _MOST_NAMES else ''
    about = f'{", ".join(names[:_MOST_NAMES])}{more}: as described, not judged'
    return tag(
        'header',
        tag('div', tag('h1', 'ros2cc-extract'), tag('p', escape(about))),
        f'<input type="search" class="search" placeholder="{_SEARCH}" aria-label="{_SEARCH}">',
        tag('button', '◐', class_='theme', title='light or dark'),
        tag('output', '', class_='found'),
        class_='top',
    )
