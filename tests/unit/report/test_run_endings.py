"""What a run ends in stands below its last step, in every format that shows the run."""

from __future__ import annotations

import io
import json
import re
from dataclasses import replace
from pathlib import Path

from report_samples import RACE, RUN, check_of
from rich.console import Console

from ros2cc_extract.report.html.page import html_report
from ros2cc_extract.report.machine.json_report import check_data
from ros2cc_extract.report.machine.sarif import sarif
from ros2cc_extract.report.text.findings import print_findings
from ros2cc_extract.report.text.paths import Paths

ENDS = 'nothing moves any more: drive waits on thread_0 for client; no thread is left'
FINDING = replace(RACE, run=replace(RUN, cycle_from=None, closing=ENDS, left_out=8))


def test_text() -> None:
    stream = io.StringIO()
    print_findings([FINDING], Paths(Path()), Console(file=stream, width=70))
    assert [line.split() for line in stream.getvalue().splitlines()[-3:]] == [
        ['3', 'on_reset', 'starts', 'on', 'thread_1', 'arm', 'node.py:35'],
        ENDS.split(),
        ['(8', 'steps', 'left', 'out)'],
    ]


def test_html() -> None:
    page = html_report(check_of(FINDING))
    assert re.findall(r'<p class="closing">(.*?)</p>', page) == [
        ENDS,
        '(8 steps left out)',
    ]


def test_sarif() -> None:
    (run,) = json.loads(sarif([FINDING]))['runs']
    (flow,) = run['results'][0]['codeFlows']
    assert flow['message']['text'] == (
        f'a run of the model that shows it; {ENDS}; (8 steps left out)'
    )


def test_json() -> None:
    data = check_data(check_of(FINDING))
    evidence = data['findings'][0]['evidence']
    assert (evidence['closing'], evidence['left_out']) == (ENDS, 8)


def test_a_run_without_one_says_nothing() -> None:
    (run,) = json.loads(sarif([RACE]))['runs']
    (flow,) = run['results'][0]['codeFlows']
    assert flow['message']['text'] == 'a run of the model that shows it'
    assert 'closing' not in html_report(check_of(RACE)).split('</style>')[1]
