"""A few findings of every kind, for all formats."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.report.shared.checked import Checked
from ros2cc_extract.source_locations import Place
from ros2cc_extract.verify.results.evidence import Evidence, Moment, Sentence


def at(line: int, file: str = 'src/arm node.py') -> Place:
    return Place(file, line, 9)


RUN = Evidence(
    start={'executor': 'polling', 'thread_0': 'wait', 'thread_1': 'wait'},
    moments=(
        Moment(
            number=1,
            sentences=(Sentence('executor', 'executor assigns tick to thread_0'),),
            places=(('tick', at(30)),),
            changes={'thread_0': 'assigned'},
        ),
        Moment(
            number=2,
            sentences=(
                Sentence('thread_0', 'tick starts on thread_0'),
                Sentence('executor', 'executor polls'),
            ),
            places=(('tick', at(30)),),
            changes={'thread_0': 'running', 'n': 1},
        ),
        Moment(
            number=3,
            sentences=(Sentence('thread_1', 'on_reset starts on thread_1'),),
            places=(('on_reset', at(35)),),
            changes={'thread_1': 'running'},
        ),
    ),
    cycle_from=2,
    ends=None,
)
CALL = Finding(
    code='CC101',
    severity=Severity.ERROR,
    place=at(40),
    message='drive waits for "plan": <for ever>, 100 %',
    help='give the client a group',
    unit='arm',
    subjects=('drive', 'plan_client'),
    chain=(Remark(at(20), 'drive calls from here'),),
    related=(Remark(at(10), 'client is created here'),),
)
RACE = Finding(
    code='CC301',
    severity=Severity.WARNING,
    place=at(30),
    message='tick updates Arm.count | too',
    unit='arm',
    subjects=('Arm.count', 'tick', 'on_reset'),
    run=RUN,
)
NOTE = Finding(
    code='CC501',
    severity=Severity.NOTE,
    place=Place('other.py'),
    message='topic of tick not resolved:\na parameter\x00',
    unit='arm',
    subjects=('tick',),
)
FINDINGS = (CALL, RACE, NOTE)


def check_of(*findings: Finding, **more: Any) -> Checked:
    """Give the result of a check that found this."""
    result = Checked(
        units=[],
        verifications=[],
        findings=findings,
        summary={'files': 2, 'errors': 1},
        files=['src/arm node.py'],
        sources={},
    )
    return replace(result, **more)
