"""
One self-contained page: an index of units, findings, what is proven, and runs to step through.

Everything is in the file: no font, script or picture is loaded. Times and memory are left out,
so that the same input gives the same bytes. What is long is there once, and links lead to it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from html import escape
from importlib.resources import files

from ros2cc_extract.report.html.excerpts import Excerpts
from ros2cc_extract.report.html.findings import (
    Numbered,
    by_weight,
    findings_section,
    rules_section,
)
from ros2cc_extract.report.html.parts import SEVERITY_WORDS, tag
from ros2cc_extract.report.html.runs import Runs
from ros2cc_extract.report.html.system_picture import system_section, unit_key
from ros2cc_extract.report.html.units import MOST_OPEN, anchor, index, unit_section
from ros2cc_extract.report.html.verdicts import verdict_table
from ros2cc_extract.report.shared.checked import Checked
from ros2cc_extract.report.shared.finding_units import is_about
from ros2cc_extract.report.shared.last_line import last_line
from ros2cc_extract.report.shared.unit_rows import Row, worst_first
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.text_escaping import one_line, printable
from ros2cc_extract.version import __version__

POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
"""The browser loads nothing, no matter what the page holds."""


def html_report(checked: Checked) -> str:
    """Write the report of a check."""
    findings = by_weight(printable(checked.findings))
    sources = {one_line(file): text for file, text in checked.sources.items()}
    excerpts, runs = Excerpts(sources), Runs()
    rows = worst_first(checked.units, checked.promises)
    units = [row.unit for row in sorted(rows, key=lambda row: row.place)]
    own = [_about(row, findings, units) for row in rows]
    cards = findings_section(findings, units, excerpts, runs)
    sections = ''.join(
        unit_section(row, mine, _verdicts(row, checked, runs), opened=len(rows) <= MOST_OPEN)
        for row, mine in zip(rows, own, strict=True)
    )
    body = (
        _header(findings, checked.summary),
        _system(checked, rows),
        index(rows, own),
        cards,
        tag('section', sections, class_='units'),
        rules_section(findings),
        excerpts.section(),
    )
    return page(''.join(body), runs.data())


def _system(checked: Checked, rows: Sequence[Row]) -> str:
    """The picture of what launch files start."""
    if checked.system is None:
        return ''
    return system_section(checked.system, {unit_key(row.unit): anchor(row) for row in rows})


def _about(row: Row, findings: Numbered, units: Sequence[Spec]) -> Numbered:
    return [(number, each) for number, each in findings if is_about(each, row.unit, units)]


def _verdicts(row: Row, checked: Checked, runs: Runs) -> str:
    if not checked.with_verdicts or not checked.verifications:
        return ''
    return verdict_table(printable(checked.verifications[row.place]), row.unit, runs)


def _header(findings: Numbered, summary: Mapping[str, int]) -> str:
    counts = Counter(finding.severity for _, finding in findings)
    tiles = ''.join(
        tag(
            'button',
            tag('b', str(counts[severity])),
            escape(f'{word}{"" if counts[severity] == 1 else "s"}'),
            class_=f'tile {word}',
            data_filter=word,
            aria_pressed='false',
        )
        for severity, word in SEVERITY_WORDS.items()
    )
    words = 'search findings and units'
    return tag(
        'header',
        tag('div', tag('h1', 'ros2cc-extract'), tag('p', escape(last_line(summary)))),
        tag('div', tiles, class_='tiles'),
        f'<input type="search" class="search" placeholder="{words}" aria-label="{words}">',
        tag('button', '◐', class_='theme', title='light or dark'),
        tag('output', '', class_='found'),
        class_='top',
    )


def page(body: str, data: str) -> str:
    """The whole page around finished HTML."""
    return f"""\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{POLICY}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="ros2cc-extract {__version__}">
<title>ros2cc-extract</title>
<style>
{_asset('report.css')}</style>
</head>
<body>
{body}
<script type="application/json" id="runs">{data}</script>
<script>
{_asset('report.js')}</script>
</body>
</html>
"""


def _asset(name: str) -> str:
    folder = files('ros2cc_extract.report.html').joinpath('assets')
    return folder.joinpath(name).read_text(encoding='utf-8')
