"""Sizes and verdicts of the published model (DOI 10.1142/S0218194026500439)."""

import pytest
from generator_units import closed_unit

from ros2cc_extract.checker.api import CheckResult, Verdict, check, read_model
from ros2cc_extract.generator.build import Family, Text, render
from ros2cc_extract.spec.close import ClosedSpec

KINDS = {1: ['TMR'], 2: ['TMR', 'SUB'], 3: ['TMR', 'TMR', 'SUB'], 4: ['TMR', 'TMR', 'SUB', 'SUB']}

HOLDS = {
    'EXCLUSIVE': {Family.NEVER_TOGETHER, Family.GROUP_CLOSED},
    'REENTRANT': {Family.CAN_OVERLAP, Family.GROUP_OPEN},
}


def one_group(kind: str, callbacks: int, threads: int) -> ClosedSpec:
    rows = ' '.join(f'cb{index}:{type_}:g' for index, type_ in enumerate(KINDS[callbacks]))
    return closed_unit(rows, f'g:{kind}', threads)


def explore(unit: ClosedSpec, text: Text) -> CheckResult:
    model = read_model(render(unit, text=text).xml, 'arm.xml')
    return check(model, model.queries, reduction=False)


@pytest.mark.parametrize(
    ('kind', 'callbacks', 'threads', 'size'),
    [
        ('EXCLUSIVE', 1, 1, (57, 85)),
        ('REENTRANT', 1, 1, (57, 85)),
        ('EXCLUSIVE', 2, 2, (2_498, 4_416)),
        ('REENTRANT', 2, 2, (3_454, 6_253)),
        ('EXCLUSIVE', 3, 3, (31_262, 64_020)),
        ('EXCLUSIVE', 4, 1, (25_978, 66_004)),
    ],
)
def test_plain_text_has_the_states_and_transitions_of_the_published_model(
    kind: str, callbacks: int, threads: int, size: tuple[int, int]
):
    result = explore(one_group(kind, callbacks, threads), Text.PLAIN)
    assert (result.states, result.transitions) == size


@pytest.mark.parametrize(
    ('kind', 'threads', 'starving'),
    [
        pytest.param('EXCLUSIVE', 1, 'cb0 cb1', id='C1'),
        pytest.param('EXCLUSIVE', 4, 'cb0 cb1 cb2 cb3', id='C2'),
        pytest.param('REENTRANT', 4, 'cb0 cb1', id='C3'),
    ],
)
def test_compact_text_gives_the_published_verdicts(kind: str, threads: int, starving: str):
    unit = one_group(kind, 4, threads)
    answers = explore(unit, Text.COMPACT).answers
    holds = {Family.DEADLOCK, Family.EXECUTABLE, *HOLDS[kind]}
    for query, answer in zip(render(unit).queries, answers, strict=True):
        if query.family is Family.STARVATION:
            expected = query.callbacks[0] not in starving.split()
        else:
            expected = query.family in holds
        assert (answer.verdict is Verdict.SATISFIED) == expected, query.words
