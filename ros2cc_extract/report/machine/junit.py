"""
Findings as JUnit XML, the way ament linters write it and ``colcon test-result`` reads it.

One suite, ``<package>.ros2cc``: a failed case per error or warning, a passed case per file
without one; notes and the last line of the text report stand in the output of the suite.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from xml.etree import ElementTree

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.text_escaping import printable, without_commands

_NOT_XML = re.compile('[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]')
"""What XML 1.0 does not allow even as a reference."""


def junit(
    findings: Sequence[Finding], files: Sequence[str], package: str, *, line: str = ''
) -> str:
    """
    Write one test suite.

    :param files: every file that was looked at.
    :param package: what the suite is named after.
    :param line: what the text report ends with.
    """
    findings, files = printable(findings), printable(files)
    failures = [f for f in findings if f.severity is not Severity.NOTE]
    failed = {finding.place.file for finding in failures}
    passed = sorted(set(files) - failed)
    name = f'{package}.ros2cc'
    suite = ElementTree.Element(
        'testsuite',
        name=name,
        tests=str(len(failures) + len(passed)),
        errors='0',
        failures=str(len(failures)),
        time='0',
    )
    suite.extend(_failed_case(finding, name) for finding in failures)
    suite.extend(_passed_case(file, name) for file in passed)
    suite.extend(_output(findings, line))
    ElementTree.indent(suite)
    text = ElementTree.tostring(suite, encoding='unicode')
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _failed_case(finding: Finding, suite: str) -> ElementTree.Element:
    case = _case(f'{finding.code} ({finding.place})', suite)
    failure = ElementTree.SubElement(case, 'failure', message=_clean(finding.message))
    failure.text = _clean('\n'.join(_lines(finding)))
    return case


def _passed_case(file: str, suite: str) -> ElementTree.Element:
    return _case(file, suite)


def _case(name: str, suite: str) -> ElementTree.Element:
    return ElementTree.Element('testcase', name=_clean(name), classname=suite, time='0')


def _lines(finding: Finding) -> Iterator[str]:
    yield f'{finding.place}: {finding.code} {finding.message}'
    for remark in (*finding.chain, *finding.related):
        yield f'{remark.place}: {remark.text}'
    if finding.help:
        yield f'help: {finding.help}'


def _output(findings: Sequence[Finding], line: str) -> Iterator[ElementTree.Element]:
    notes = [f for f in findings if f.severity is Severity.NOTE]
    lines = [f'{note.place}: {note.code} {note.message}' for note in notes]
    lines += [line] if line else []
    if lines:
        output = ElementTree.Element('system-out')
        output.text = _clean('\n'.join(lines))
        yield output


def _clean(text: str) -> str:
    return without_commands(_NOT_XML.sub('\ufffd', text))
