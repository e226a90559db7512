"""
Each help, carried out literally on a program that has the finding, and checked again.

Both programs run on real rclpy in ``tests/live/test_live_help.py``.
"""

from __future__ import annotations

import re

import pytest

from ros2cc_extract.findings.rules.registry import BY_CODE, RULES
from tests.help.cases import Case, Mended, cases, said

# Words that only join what is to be done.
JOINS = r'(?i)\W|\b(or|and|then|instead)\b'
# Nothing is wrong with the program, or nothing of its own.
NO_PROGRAM = {
    'CC206': 'on rclpy 3.3.9 and older alone, which no wheel is there for',
    'CC500': 'what cannot be read is no program',
    'CC501': 'what is not resolved is no fault',
    'CC502': 'a comment of the check itself',
    'CC601': 'a requirement, which is not in the program',
    'CC602': 'a requirement, which is not in the program',
    'CC603': 'a requirement, which is not in the program',
    'CC701': 'a system of several programs: tests/systems',
    'CC702': 'a system of several programs: tests/systems',
    'CC703': 'a system of several programs: tests/systems',
    'CC704': 'a system of several programs: tests/systems',
    'CC706': 'a system of several programs: tests/systems',
    'CC707': 'a system of several programs: tests/systems',
    'CC708': 'a system of several programs: tests/systems',
    'CC709': 'a system of several programs: tests/systems',
    'CC705': 'a system of several programs: tests/systems',
}
PAIRS = [
    pytest.param(case, mended, id=f'{case.name}-{at}')
    for case in cases()
    for at, mended in enumerate(case.mended, 1)
]


@pytest.mark.parametrize('case', cases(), ids=lambda case: case.name)
def test_the_finding_names_the_place_the_cause_and_the_way_out(case: Case) -> None:
    found = [(f.line, f.message, f.help) for f in said(case.text) if f.code == case.code]
    assert (case.line, case.says, case.help) in found


@pytest.mark.parametrize(('case', 'mended'), PAIRS)
def test_what_is_left_when_a_help_was_carried_out(case: Case, mended: Mended) -> None:
    left = said(case.mended_text(mended))
    assert tuple(each.code for each in left) == mended.left
    assert not mended.says or any(mended.says in each.message for each in left)


@pytest.mark.parametrize(('case', 'mended'), PAIRS)
def test_what_is_carried_out_is_what_is_said(case: Case, mended: Mended) -> None:
    told = f'{case.help}\n{BY_CODE[case.code].mend}'.casefold()
    assert [words for words in mended.does if words.casefold() not in told] == []


@pytest.mark.parametrize('case', cases(), ids=lambda case: case.name)
def test_every_way_out_is_carried_out(case: Case) -> None:
    words = [words for mended in case.mended for words in mended.does]
    assert _rest(case.help, [*words, *case.aside]) == ''


@pytest.mark.parametrize('code', sorted({case.code for case in cases()}))
def test_every_way_out_on_the_page_of_a_rule_is_carried_out(code: str) -> None:
    of_it = [case for case in cases() if case.code == code]
    words = [words for case in of_it for mended in case.mended for words in mended.does]
    aside = [words for case in of_it for words in case.aside]
    assert _rest(BY_CODE[code].mend, [*words, *aside]) == ''


def _rest(text: str, done: list[str]) -> str:
    for words in sorted(done, key=len, reverse=True):
        text = re.sub(re.escape(words), '', text, flags=re.IGNORECASE)
    return re.sub(JOINS, '', text)


def test_every_rule_has_its_help_carried_out() -> None:
    assert {case.code for case in cases()} | set(NO_PROGRAM) == {rule.code for rule in RULES}
