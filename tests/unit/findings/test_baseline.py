"""Fingerprints, baselines and switched-off rules."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.errors import InputError
from ros2cc_extract.findings.base.fingerprints import fingerprints, relative
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.filters.baseline import compare, read_baseline, write_baseline
from ros2cc_extract.findings.filters.selection import Selection, select
from ros2cc_extract.source_locations import Place

CALL = Finding(
    code='CC101',
    severity=Severity.ERROR,
    place=Place('src/arm.py', 40, 9),
    message='drive waits',
    unit='arm',
    subjects=('drive',),
)
NOTE = replace(CALL, code='CC402', severity=Severity.NOTE)
OTHER = replace(CALL, place=Place('src/leg.py', 7))


def moved(finding: Finding, line: int) -> Finding:
    return replace(finding, place=Place(finding.place.file, line))


def test_fingerprints_survive_moved_lines_and_tell_equal_findings_apart() -> None:
    assert fingerprints([CALL]) == fingerprints([moved(CALL, 99)])
    first, second = fingerprints([CALL, moved(CALL, 99)])
    assert first.endswith(':1') and second == first[:-1] + '2'
    assert fingerprints([CALL]) != fingerprints([replace(CALL, subjects=('other',))])
    assert fingerprints([CALL]) != fingerprints([OTHER])


def test_paths_are_relative_to_the_root() -> None:
    assert relative('/repo/src/arm.py', '/repo') == 'src/arm.py'
    assert relative('/repository/arm.py', '/repo/') == '/repository/arm.py'
    assert relative('./src/../arm.py') == 'arm.py'
    inside = replace(CALL, place=Place('/repo/src/arm.py', 1))
    assert fingerprints([inside], '/repo') == fingerprints([CALL])


def test_what_was_known_is_not_new_though_it_moved() -> None:
    known = read_baseline(write_baseline([CALL, NOTE]), 'base.json')
    result = compare([moved(CALL, 99), OTHER, NOTE], known)
    assert result.known == (moved(CALL, 99),)
    assert result.new == (OTHER, NOTE)
    assert result.gone == frozenset()


def test_what_was_mended_is_gone() -> None:
    known = read_baseline(write_baseline([CALL, OTHER]), 'base.json')
    assert compare([OTHER], known).gone == frozenset(fingerprints([CALL]))


def test_a_second_finding_of_the_same_kind_is_new() -> None:
    known = read_baseline(write_baseline([CALL]), 'base.json')
    assert compare([CALL, moved(CALL, 50)], known).new == (moved(CALL, 50),)


def test_a_baseline_does_not_depend_on_the_order() -> None:
    assert write_baseline([CALL, OTHER]) == write_baseline([OTHER, CALL])


@pytest.mark.parametrize(
    ('text', 'complaint'),
    [
        ('{', 'base.json:1:2: no JSON: Expecting property name'),
        (f'[1{"0" * 5_000}]', 'base.json: no '),
        ('[]', 'base.json: no baseline of version 1; write it anew by --write-baseline'),
        ('{"ros2cc_baseline": 2}', 'base.json: no baseline of version 1'),
        (
            '{"ros2cc_baseline": 1, "findings": null}',
            'base.json: a finding of the baseline has no',
        ),
        ('{"ros2cc_baseline": 1, "findings": [1]}', 'base.json: a finding of the baseline has no'),
    ],
)
def test_what_is_no_baseline_is_refused(text: str, complaint: str) -> None:
    with pytest.raises(InputError) as caught:
        read_baseline(text, 'base.json')
    assert str(caught.value).startswith(complaint)


def test_rules_are_switched_off_everywhere_or_by_path() -> None:
    selection = Selection(ignore=('CC4',), per_path=(('src/leg*', ('CC1',)),))
    assert select([CALL, NOTE, OTHER], selection) == (CALL,)
    inside = replace(OTHER, place=Place('/repo/src/leg.py', 7))
    assert select([inside], selection, '/repo') == ()
