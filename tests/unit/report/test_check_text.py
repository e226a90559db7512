"""The text of a whole check: tables for a few units, rows for many; notes counted by file."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import pytest
from report_samples import CALL, NOTE, RACE

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.places import Place, Unknown
from ros2cc_extract.report.text.check import print_check
from ros2cc_extract.report.text.style import console_for
from ros2cc_extract.spec.close import Policy, close
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

EXAMPLE = Path(__file__).parents[3] / 'launch_free_examples' / 'service_deadlock' / 'node.py'
SUMMARY = {
    'files': 1,
    'units': 4,
    'callbacks': 12,
    'satisfied': 44,
    'not_satisfied': 28,
    'undecided': 0,
    'errors': 1,
    'warnings': 0,
    'notes': 2,
    'undecided_waits': 1,
    'accepted': 3,
}


@pytest.fixture(autouse=True)
def width_of_a_log(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('COLUMNS', raising=False)


@pytest.fixture(scope='module')
def checked() -> tuple[Spec, Verification]:
    [unit] = scan([EXAMPLE], root=EXAMPLE.parent).units
    return unit, verify_unit(close(unit, Policy()), Options())


def told(
    checked: tuple[Spec, Verification],
    findings: list[Finding],
    *,
    units: int = 4,
    tables: bool = False,
) -> str:
    stream = io.StringIO()
    unit, verification = checked
    many = [(replace(unit, name=f'unit_{n}'), verification) for n in range(units)]
    print_check(many, findings, SUMMARY, console_for(stream), tables=tables)
    return stream.getvalue()


def without_executor(unit: Spec, name: str) -> Spec:
    executor = replace(unit.executor, kind=Unknown('nobody spins it'), threads=('thread_0',))
    return replace(unit, name=name, executor=executor, entry=None, sources=('arm/test/arm.py',))


def test_many_units_are_a_row_each(checked: tuple[Spec, Verification]) -> None:
    finding = replace(CALL, unit='unit_2')
    text = told(checked, [finding, replace(RACE, unit='unit_2', run=None)])
    assert text.splitlines()[0].split() == [
        *('unit', 'entry', 'executor', 'callbacks', 'groups', 'overlapping', 'findings')
    ]
    rows = [line for line in text.splitlines() if line.startswith('unit_')]
    assert [row.split()[0] for row in rows] == ['unit_0', 'unit_1', 'unit_2', 'unit_3']
    assert rows[2].endswith('1 error, 1 warning')
    assert rows[3].endswith('-')
    assert 'counterexample' not in text


def test_units_without_an_executor_are_rows_where_something_is_found(
    checked: tuple[Spec, Verification],
) -> None:
    unit, verification = checked
    open_units = [without_executor(unit, f'open_{n}') for n in range(4)]
    units = [(each, verification) for each in (unit, *open_units)]
    stream = io.StringIO()
    finding = replace(CALL, unit='open_2')
    print_check(units, [finding], SUMMARY, console_for(stream))
    rows = [line.split() for line in stream.getvalue().splitlines()[1:4]]
    assert [row[:2] for row in rows] == [
        ['map_server_and_navigator', 'node.py:main'],
        ['open_2', 'test/arm.py'],
        ['3', 'units'],
    ]
    assert (
        '3 units without an executor in sight, no error, no warning: see --tables\n'
        in stream.getvalue()
    )


def test_a_unit_without_an_entry_is_told_by_the_file_that_is_its_own(
    checked: tuple[Spec, Verification],
) -> None:
    unit, verification = checked
    names = ('one', 'two', 'three', 'four')
    units = [
        replace(unit, name=name, entry=None, sources=('test/common.py', f'test/test_{name}.py'))
        for name in names
    ]
    stream = io.StringIO()
    print_check([(each, verification) for each in units], [], SUMMARY, console_for(stream))
    rows = [line.split()[:2] for line in stream.getvalue().splitlines()[1:5]]
    assert rows == [[name, f'test/test_{name}.py'] for name in names]


def test_the_last_line_begins_with_what_decides(checked: tuple[Spec, Verification]) -> None:
    assert told(checked, []).splitlines()[-1] == (
        '1 error, 0 warnings, 2 notes, 1 undecided wait, 3 accepted in 1 file, 4 units, '
        '12 callbacks; verdicts: 44 satisfied, 28 not satisfied, 0 undecided'
    )


def test_an_undecided_wait_is_a_line_of_its_own_among_however_many_notes(
    checked: tuple[Spec, Verification],
) -> None:
    wait = replace(NOTE, code='CC120', message='not decided: feed waits in Barrier.wait')
    lines = told(checked, [NOTE] * 11 + [wait]).splitlines()
    assert f'{NOTE.place}: CC120 not decided: feed waits in Barrier.wait' in lines


@pytest.mark.parametrize(('units', 'tables'), [(3, False), (4, True)])
def test_a_few_units_have_their_tables(
    checked: tuple[Spec, Verification], units: int, tables: bool
) -> None:
    text = told(checked, [], units=units, tables=tables)
    assert text.count('  #  query') == units


def test_many_notes_are_counted_by_file(checked: tuple[Spec, Verification]) -> None:
    text = told(checked, [NOTE] * 11 + [CALL])
    assert 'CC501 topic of tick' not in text
    assert 'CC101 drive waits' in text
    assert '11 notes, each with its line by --tables:\n  other.py  CC501 × 11\n' in text


def test_notes_of_many_files_are_counted_together(checked: tuple[Spec, Verification]) -> None:
    notes = [replace(NOTE, place=Place(f'node_{n:02}.py', 3)) for n in range(13)]
    lines = told(checked, [*notes, notes[0]]).splitlines()
    first = lines.index('14 notes, each with its line by --tables:') + 1
    assert [line.split() for line in lines[first : first + 2]] == [
        ['node_00.py', 'CC501', '×', '2'],
        ['node_01.py', 'CC501', '×', '1'],
    ]
    assert lines[first + 10].split() == ['3', 'more', 'files', 'CC501', '×', '3']


def test_many_related_places_are_cut(checked: tuple[Spec, Verification]) -> None:
    related = tuple(Remark(Place('node.py', line), 'waits here') for line in range(1, 12))
    text = told(checked, [replace(CALL, chain=(), related=related)])
    assert text.count('waits here') == 8
    assert '  and 3 places more: see --output-format html\n' in text


@pytest.mark.parametrize(('notes', 'tables'), [(10, False), (11, True)])
def test_a_few_notes_are_told(
    checked: tuple[Spec, Verification], notes: int, tables: bool
) -> None:
    text = told(checked, [NOTE] * notes, tables=tables)
    assert text.count('CC501 topic of tick') == notes


def test_a_run_of_the_published_starvation_is_left_to_verify(
    checked: tuple[Spec, Verification],
) -> None:
    lines = told(checked, [], units=1).splitlines()
    assert [line for line in lines if line.startswith('counterexample')] == [
        'counterexample for 5: on_map_ready and drive never run at the same time: not satisfied'
    ]
    assert '  3 more runs: ros2cc-extract verify shows them' in lines


def test_programs_that_name_their_node_alike_have_the_findings_of_their_own_files(
    checked: tuple[Spec, Verification],
) -> None:
    unit, verification = checked
    many = [
        (replace(unit, name='arm', sources=(f'{file}.py',), entry=f'{file}.py:main'), verification)
        for file in ('old', 'new', 'newest', 'other')
    ]
    many[3] = (replace(many[3][0], name='other'), verification)
    made = Remark(at('new.py'), 'made here')
    about_new = replace(CALL, unit='arm', place=at('library.py'), chain=(), related=(made,))
    stream = io.StringIO()
    print_check(many, [about_new], SUMMARY, console_for(stream))
    rows = {line.split()[1]: line for line in stream.getvalue().splitlines() if '.py:main' in line}
    assert rows['new.py:main'].endswith('1 error')
    assert all(rows[f'{name}.py:main'].endswith('-') for name in ('old', 'newest', 'other'))


def test_namesakes_share_a_finding_that_shows_none_of_their_files(
    checked: tuple[Spec, Verification],
) -> None:
    unit, verification = checked
    many = [
        (replace(unit, name='arm', sources=(f'{n}.py',), entry=f'{n}.py:main'), verification)
        for n in range(4)
    ]
    nowhere = replace(CALL, unit='arm', place=at('library.py'), chain=(), related=())
    stream = io.StringIO()
    print_check(many, [nowhere], SUMMARY, console_for(stream))
    assert stream.getvalue().count('1 error\n') == len(many)


def test_of_namesakes_in_one_file_the_one_with_an_executor_has_the_finding(
    checked: tuple[Spec, Verification],
) -> None:
    unit, verification = checked
    spun = replace(unit, name='arm', sources=('arm/test/arm.py',))
    many = [(spun, verification)]
    many += [(without_executor(unit, 'arm'), verification) for _ in range(4)]
    stream = io.StringIO()
    print_check(
        many,
        [replace(CALL, unit='arm', place=at('arm/test/arm.py'))],
        SUMMARY,
        console_for(stream),
    )
    rows = [line for line in stream.getvalue().splitlines() if line.startswith('arm')]
    assert [row.endswith('1 error') for row in rows][:1] == [True]
    assert len([row for row in rows if '1 error' in row]) == 1
    assert '4 units without an executor in sight' in stream.getvalue()


def at(file: str) -> Place:
    return Place(file, 3, 1)
