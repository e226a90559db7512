"""What came of a finding on the running node stands in every report that can hold it."""

from __future__ import annotations

import io
import json
from dataclasses import replace
from pathlib import Path

from rich.console import Console

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding, OnNode
from ros2cc_extract.report.html.excerpts import Excerpts
from ros2cc_extract.report.html.findings import findings_section
from ros2cc_extract.report.html.runs import Runs
from ros2cc_extract.report.machine.json_report import check_data
from ros2cc_extract.report.machine.sarif import sarif
from ros2cc_extract.report.shared.checked import Checked
from ros2cc_extract.report.text.findings import print_findings
from ros2cc_extract.report.text.paths import Paths
from ros2cc_extract.source_locations import Place

FINDING = Finding(
    code='CC101', severity=Severity.ERROR, place=Place('node.py', 24), message='waits'
)
ON_NODE = OnNode(
    'confirmed',
    '7.1.6',
    'waits at line 24',
    'process 1: deadlock\n  node.py:24',
    ('0.1 s  begins',),
)
TRIED = replace(FINDING, on_node=ON_NODE)
AS_DATA = {
    'outcome': 'confirmed',
    'release': '7.1.6',
    'reason': 'waits at line 24',
    'evidence': 'process 1: deadlock\n  node.py:24',
    'run': ['0.1 s  begins'],
}


def test_text_says_it_in_a_line() -> None:
    stream = io.StringIO()
    print_findings([TRIED], Paths(Path.cwd()), Console(file=stream, width=200))
    assert '  confirmed on rclpy 7.1.6: waits at line 24\n' in stream.getvalue()


def test_no_release_is_made_up() -> None:
    assert replace(ON_NODE, release=None).words == 'confirmed on rclpy: waits at line 24'


def test_json_and_sarif_hold_it_only_where_it_was_tried() -> None:
    summary = dict.fromkeys(
        ('files', 'units', 'callbacks', 'satisfied', 'not_satisfied', 'undecided', 'errors',
         'warnings', 'notes', 'undecided_waits', 'accepted'), 0,
    )  # fmt: skip
    checked = Checked(
        units=(),
        verifications=(),
        findings=(TRIED, FINDING),
        summary=summary,
        files=(),
        sources={},
    )
    tried, untried = check_data(checked)['findings']
    assert json.loads(json.dumps(tried['on_node'])) == AS_DATA
    assert 'on_node' not in untried
    first, second = json.loads(sarif([TRIED, FINDING]))['runs'][0]['results']
    assert first['properties'] == {'onNode': AS_DATA}
    assert 'properties' not in second


def test_page_shows_the_steps_of_the_node_and_its_evidence() -> None:
    numbered = list(enumerate([TRIED, FINDING], start=1))
    page = findings_section(numbered, [], Excerpts({}), Runs())
    assert page.count('On the running node') == 1
    assert '<li>0.1 s  begins</li>' in page
    assert '<pre class="evidence">process 1: deadlock\n  node.py:24</pre>' in page
