"""The published verdicts (IJSEKE 2026, DOI 10.1142/S0218194026500439) from the real nodes."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.spec.close import Policy, close
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.unit import verify_unit
from tests.e2e.expected import EXAMPLES, scan_example

YES, NO = Verdict.SATISFIED, Verdict.NOT_SATISFIED
CASES = {
    # family: verdicts per case; the paper counts the last but one per callback, the tool per group
    'paper_case1': {
        'deadlock': [YES],
        'executable': [YES] * 4,
        'never_together': [YES] * 6,
        'group_closed_while_running': [YES] * 4,
        'can_overlap': [NO] * 6,
        'group_always_open': [NO],
        'starvation': [NO, NO, YES, YES],
    },
    'paper_case2': {
        'deadlock': [YES],
        'executable': [YES] * 4,
        'never_together': [YES] * 6,
        'group_closed_while_running': [YES] * 4,
        'can_overlap': [NO] * 6,
        'group_always_open': [NO],
        'starvation': [NO, NO, NO, NO],
    },
    'paper_case3': {
        'deadlock': [YES],
        'executable': [YES] * 4,
        'never_together': [NO] * 6,
        'group_closed_while_running': [NO] * 4,
        'can_overlap': [YES] * 6,
        'group_always_open': [YES],
        'starvation': [NO, NO, YES, YES],
    },
}
THREADS = {'paper_case3': 2}
"""Fewer threads than published where plain Python would need minutes for the plain text."""


def verify_case(name: str) -> Verification:
    folder = next(folder for folder in EXAMPLES if folder.name == name)
    (unit,) = scan_example(folder)
    return verify_unit(close(unit, Policy(threads=THREADS.get(name))))


@pytest.mark.parametrize('name', CASES)
def test_all_published_verdicts_of_a_case(name: str) -> None:
    verdicts: dict[str, list[Verdict]] = {}
    for result in verify_case(name).results:
        assert result.family is not None
        verdicts.setdefault(result.family, []).append(result.verdict)
    assert verdicts == CASES[name]
