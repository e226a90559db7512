"""Comments that accept findings, and comments that accept nothing."""

from __future__ import annotations

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.filters.suppress import Ignore, ignores_in, suppress
from ros2cc_extract.source_locations import Place

TEXT = """\
text = '# ros2cc: ignore[CC101] in a string'
self.client.call(request)  # ros2cc: ignore[CC101, long-sleep] answered elsewhere
# ros2cc: ignore[CC301]
#   a remark in between

self.count += 1
"""


def finding(code: str, line: int) -> Finding:
    place = Place('arm.py', line, 1)
    return Finding(code=code, severity=Severity.ERROR, place=place, message='so it is')


def test_a_comment_counts_for_its_line_or_the_next_line_of_code() -> None:
    assert list(ignores_in('arm.py', TEXT)) == [
        Ignore(Place('arm.py', 2, 28), 2, ('CC101', 'CC201'), 'answered elsewhere'),
        Ignore(Place('arm.py', 3, 1), 6, ('CC301',), ''),
    ]


def test_accepted_findings_are_taken_out_and_kept_apart() -> None:
    findings = [finding('CC101', 2), finding('CC201', 2), finding('CC301', 6), finding('CC101', 6)]
    result = suppress(findings, {'arm.py': TEXT})
    assert result.kept == (findings[3],)
    assert [(f.code, i.reason) for f, i in result.accepted] == [
        ('CC101', 'answered elsewhere'),
        ('CC201', 'answered elsewhere'),
        ('CC301', ''),
    ]


def test_a_comment_that_accepts_nothing_is_a_finding() -> None:
    result = suppress([finding('CC101', 2), finding('CC301', 6)], {'arm.py': TEXT})
    (unused,) = result.kept
    assert (unused.code, unused.place) == ('CC502', Place('arm.py', 2, 28))
    assert unused.message == 'CC201 is not found here any more'


def test_a_code_that_is_no_rule_is_a_finding() -> None:
    result = suppress([], {'arm.py': 'x = 1  # ros2cc: ignore[CC999]\n'})
    assert [f.message for f in result.kept] == ['CC999 is no rule']


@pytest.mark.parametrize('text', ['def f(  # ros2cc: ignore[CC101]', "x = '''# ros2cc:"])
def test_a_file_that_is_no_python_has_no_comments(text: str) -> None:
    assert list(ignores_in('arm.py', text)) == []
