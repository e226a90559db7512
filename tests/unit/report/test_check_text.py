"""The text of a whole check: findings, what was checked, what is not known, and one line."""

from __future__ import annotations

import io
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
from report_samples import CALL, NOTE, RACE, RUN

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.findings.promises import Judgement, Mark, Promise
from ros2cc_extract.report.shared.checked import Checked
from ros2cc_extract.report.text.check import Presentation, print_check
from ros2cc_extract.report.text.findings import Detail
from ros2cc_extract.report.text.style import console_for
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.close import Policy, close
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

EXAMPLE = Path(__file__).parents[3] / 'launch_free_examples' / 'service_deadlock' / 'node.py'
NONE_FOUND = {
    'files': 1,
    'units': 4,
    'callbacks': 12,
    'satisfied': 44,
    'not_satisfied': 28,
    'undecided': 0,
    'errors': 0,
    'warnings': 0,
    'notes': 0,
    'undecided_waits': 0,
    'accepted': 0,
}
KEPT = tuple(Judgement(promise, Mark.KEPT) for promise in Promise)


@pytest.fixture(autouse=True)
def width_of_a_log(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('COLUMNS', raising=False)


@cache
def example() -> tuple[Spec, Verification]:
    [unit] = scan([EXAMPLE], root=EXAMPLE.parent).units
    return unit, verify_unit(close(unit, Policy()), Options())


def told(
    findings: list[Finding],
    *,
    units: int = 1,
    promises: tuple[Judgement, ...] = KEPT,
    encoding: str = 'utf-8',
    root: str = '',
    how: Presentation | None = None,
    with_verdicts: bool = False,
    **counts: int,
) -> str:
    unit, verification = example()
    checked = Checked(
        units=[replace(unit, name=f'unit_{n}', nodes=(f'node_{n}',)) for n in range(units)],
        verifications=[verification] * units,
        findings=findings,
        summary=NONE_FOUND | {'units': units} | counts,
        promises=[promises, *[KEPT] * (units - 1)][:units],
        files=['node.py'],
        sources={},
        root=root,
        with_verdicts=with_verdicts,
    )
    raw = io.BytesIO()
    stream = io.TextIOWrapper(raw, encoding, 'backslashreplace')
    print_check(checked, console_for(stream), how or Presentation())
    stream.flush()
    return raw.getvalue().decode(encoding)


def test_a_clean_unit_is_two_lines_and_the_last() -> None:
    assert told([]).splitlines() == [
        'checked node_0: MultiThreadedExecutor, 4 threads, 3 callbacks',
        '  ✓ no deadlock  ✓ every wait ends  ✓ no starvation  ✓ no data race  '
        '✓ settings have an effect',
        'No problems found in 1 file',
    ]


def test_what_is_undecided_has_its_reason() -> None:
    is_open = (Promise.DEADLOCK, Promise.WAITS)
    promises = tuple(
        Judgement(each, Mark.OPEN, 'a limit was hit') if each in is_open else Judgement(each, mark)
        for each, mark in zip(Promise, [Mark.BROKEN] * 3 + [Mark.KEPT, Mark.BROKEN], strict=True)
    )
    assert told([], promises=promises).splitlines()[1:3] == [
        '  ? no deadlock  ? every wait ends  ✗ no starvation  ✓ no data race  '
        '✗ settings have an effect',
        '  ? no deadlock, every wait ends: a limit was hit',
    ]


def test_what_a_kept_promise_assumes_of_others_is_said() -> None:
    assumed = Judgement(Promise.WAITS, Mark.KEPT, "as long as service 'plan' answers")
    lines = told([], promises=(KEPT[0], assumed, *KEPT[2:])).splitlines()
    assert lines[2:] == [
        "  ✓ every wait ends, as long as service 'plan' answers",
        'No problems found in 1 file',
    ]
    lines = told([], units=4, promises=(KEPT[0], assumed, *KEPT[2:])).splitlines()
    assert lines[5:] == [
        '✓ every wait ends in 1 unit as long as others answer; --verbose names them',
        'No problems found in 1 file',
    ]


def test_where_only_ascii_can_be_written_marks_are_words() -> None:
    promises = (Judgement(Promise.DEADLOCK, Mark.BROKEN), *KEPT[1:])
    text = told([], promises=promises, encoding='ascii')
    assert '  NO no deadlock  ok every wait ends  ok' in text


def test_many_units_are_a_row_each_the_worst_first() -> None:
    promises = (*KEPT[:-1], Judgement(Promise.SETTINGS, Mark.OPEN, 'no executor found'))
    lines = told([], units=4, promises=promises).splitlines()
    assert [line.split() for line in lines] == [
        ['checked', 'executor', 'callbacks', 'deadlock', 'waits', 'starve', 'races', 'settings'],
        ['node_0', 'multi', '4', '3', '✓', '✓', '✓', '✓', '?'],
        *([f'node_{n}', 'multi', '4', '3', '✓', '✓', '✓', '✓', '✓'] for n in (1, 2, 3)),
        ['?', 'once:', 'no', 'executor', 'found'],
        ['No', 'problems', 'found', 'in', '1', 'file'],
    ]


def test_of_very_many_units_the_last_are_counted() -> None:
    lines = told([], units=40).splitlines()
    assert lines[29] == '12 more units, 12 with every promise kept; --verbose shows them'
    assert len(lines) == 31


@pytest.mark.parametrize(
    ('counts', 'line'),
    [
        ({}, 'No problems found in 1 file'),
        ({'errors': 1, 'notes': 2, 'files': 3}, 'Found 1 error, 2 notes in 3 files'),
        ({'warnings': 1, 'undecided_waits': 1}, 'Found 1 warning, 1 undecided wait in 1 file'),
        ({'accepted': 3}, 'No problems found in 1 file; 3 accepted'),
        ({'undecided': 2}, 'No problems found in 1 file; 2 verdicts undecided'),
        ({'units': 0}, 'Nothing to check in 1 file: no node with a callback'),
    ],
)
def test_the_last_line_says_what_was_found(counts: dict[str, int], line: str) -> None:
    assert told([], **counts).splitlines()[-1] == line


def test_a_log_is_told_no_time() -> None:
    assert told([], how=Presentation(seconds=1.0)) == told([], how=Presentation(seconds=2.0))


def test_findings_come_first_and_notes_are_a_line_each() -> None:
    lines = told([CALL, NOTE]).splitlines()
    assert lines[:5] == [
        'src/arm node.py:40:9: error CC101: drive waits for "plan": <for ever>, 100 %',
        '  src/arm node.py:20:9: drive calls from here',
        '  src/arm node.py:10:9: client is created here',
        '  help: give the client a group',
        'other.py: note CC501: topic of tick not resolved:\\na parameter\\x00',
    ]
    assert lines[5:7] == ['', 'checked node_0: MultiThreadedExecutor, 4 threads, 3 callbacks']


def test_no_path_is_absolute_below_the_folder_of_the_reader_or_the_repository() -> None:
    here = replace(CALL, place=Place(str(Path.cwd() / 'arm.py'), 3), chain=(), related=())
    below = replace(here, place=Place('/robots/src/arm.py', 3))
    assert told([here]).startswith('arm.py:3: error')
    assert told([below], root='/robots').startswith('src/arm.py:3: error')
    assert told([below]).startswith('/robots/src/arm.py:3: error')


def test_quiet_tells_each_finding_in_a_line() -> None:
    lines = told([CALL, RACE, NOTE], how=Presentation(detail=Detail.QUIET)).splitlines()
    assert [line.partition(': ')[2].partition(':')[0] for line in lines[:3]] == [
        'error CC101',
        'warning CC301',
        'note CC501',
    ]
    assert lines[3:] == ['No problems found in 1 file']


def test_a_run_has_eight_steps_and_verbose_tells_all() -> None:
    moments = tuple(replace(RUN.moments[0], number=n) for n in range(1, 21))
    long = replace(RACE, run=replace(RUN, moments=moments, cycle_from=None))
    usual, verbose = told([long]), told([long], how=Presentation(detail=Detail.VERBOSE))
    assert usual.count('executor assigns tick') == 8
    assert '(12 steps left out)' in usual
    assert verbose.count('executor assigns tick') == 20


def test_many_notes_are_counted_by_file() -> None:
    text = told([NOTE] * 11 + [CALL])
    assert 'CC501: topic of tick' not in text
    assert 'CC101: drive waits' in text
    assert '11 notes; --verbose shows each with its line:\n  other.py  CC501 × 11\n' in text


def test_notes_of_many_files_are_counted_together() -> None:
    notes = [replace(NOTE, place=Place(f'node_{n:02}.py', 3)) for n in range(13)]
    lines = told([*notes, notes[0]]).splitlines()
    assert lines[1:3] == ['  node_00.py  CC501 × 2', '  node_01.py  CC501 × 1']
    assert lines[11] == '  3 more files  CC501 × 3'


def test_many_related_places_are_cut() -> None:
    related = tuple(Remark(Place('node.py', line), 'waits here') for line in range(1, 12))
    text = told([replace(CALL, chain=(), related=related)])
    assert text.count('waits here') == 8
    assert '  and 3 places more: see --output-format html\n' in text


@pytest.mark.parametrize(
    ('notes', 'detail'), [(10, Detail.USUAL), (11, Detail.QUIET), (11, Detail.VERBOSE)]
)
def test_a_few_notes_are_told_and_all_where_somebody_asks(notes: int, detail: Detail) -> None:
    text = told([NOTE] * notes, how=Presentation(detail=detail))
    assert text.count('CC501: topic of tick') == notes


def test_tables_of_queries_are_told_where_somebody_asks() -> None:
    assert '  #  query' not in told([], units=2)
    assert told([], units=2, with_verdicts=True).count('  #  query') == 2


def test_a_run_of_the_published_starvation_is_left_to_verify() -> None:
    lines = told([], with_verdicts=True).splitlines()
    assert [line for line in lines if line.startswith('counterexample')] == [
        'counterexample for 5: on_map_ready and drive never run at the same time: not satisfied'
    ]
    assert '  3 more runs: ros2cc-extract verify shows them' in lines
