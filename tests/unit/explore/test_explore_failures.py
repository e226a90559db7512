"""Two looks, far enough apart, at what stands: a hang, or only something that takes long."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from ros2cc_extract.confirm.observations import Sample
from ros2cc_extract.explore.failures import Failure, Kind, hang, stands
from ros2cc_extract.explore.wording import shown_path
from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind as Waits
from ros2cc_extract.extract.live.hang_analysis.frame_waits import Wait
from ros2cc_extract.extract.live.hang_analysis.samples import Activity, Frame, Look
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import (
    Explanation,
    Standing,
    Verdict,
)

LOOK = Look(
    main=1, nodes=('/arm',), activities=(), entities={}, executors=(), objects={}, unread=()
)


def standing(line: int, kind: Waits, *, can_end: bool, number: int = 1) -> Standing:
    """A callback that waits at a line."""
    frame = Frame(
        number=number,
        file='arm.py',
        function='step',
        called=f'Arm.step_{line}',
        module='arm',
        line=line,
        at=4,
        position=None,
        item=None,
        objects={},
        endless=True,
        entity=7,
    )
    activity = Activity(name=f'thread {number}', frames=(frame,), ident=number)
    return Standing(activity, Wait(kind), moved=False, can_end=can_end)


def sample(at: float, *standings: Standing, verdict: Verdict = Verdict.UNDECIDED) -> Sample:
    return Sample(at, (LOOK, LOOK), Explanation(4711, verdict, standings, LOOK))


def words(found: Failure | None) -> tuple[Kind, int, str] | None:
    return None if found is None else (found.kind, found.line, found.words)


def test_what_never_ends_in_two_looks_is_a_hang() -> None:
    stuck = standing(24, Waits.LOCK, can_end=False)
    text = 'Arm.step_24 waits forever for a lock, and nothing is left that could end it'
    assert words(hang([sample(0, stuck), sample(2.5, stuck)])) == (Kind.HANG, 24, text)
    assert hang([sample(0, stuck), sample(1, stuck)]) is None, 'too soon'
    moved = replace(stuck, moved=True)
    assert hang([sample(0, stuck), sample(2.5, moved)]) is None
    elsewhere = standing(24, Waits.LOCK, can_end=False, number=2)
    assert hang([sample(0, stuck), sample(2.5, elsewhere)]) is None, 'it is another call'


def test_nothing_is_judged_where_a_look_could_not_read_all() -> None:
    stuck = standing(24, Waits.LOCK, can_end=False)
    last = sample(2.5, stuck)
    blind = replace(last, explanation=replace(last.explanation, look=replace(LOOK, unread=('x',))))
    assert hang([sample(0, stuck), blind]) is None


def test_all_callbacks_that_wait_for_locks_are_a_hang_though_it_is_not_known_for_which() -> None:
    both = [
        standing(24, Waits.LOCK, can_end=True),
        standing(32, Waits.LOCK, can_end=True, number=2),
    ]
    found = words(hang([sample(0, *both), sample(3, *both)]))
    text = 'every callback at work waits for a lock, at lines 24 and 32, for 3 s'
    assert found == (Kind.HANG, 24, text)
    other = standing(40, Waits.NOTHING, can_end=True, number=3)
    assert hang([sample(0, *both, other), sample(3, *both, other)]) is None, 'it may hold them'
    assert hang([sample(0, both[0]), sample(3, both[0])]) is None


def test_an_executor_that_nobody_spins_is_a_hang() -> None:
    main = standing(9, Waits.EVENT, can_end=True)
    looks = [sample(at, main, verdict=Verdict.NEVER_SPUN) for at in (0, 3)]
    found = hang(looks)
    assert found is not None and 'no thread has ever spun it' in found.words


def test_what_may_still_end_only_stands() -> None:
    waits = standing(33, Waits.EVENT, can_end=True)
    assert hang([sample(0, waits), sample(7, waits)]) is None
    text = 'Arm.step_33 waits for an event for 7 s and more; whether that ever ends is not decided'
    assert words(stands([sample(0, waits), sample(7, waits)])) == (Kind.STANDS, 33, text)
    assert stands([sample(0, waits)]) is None
    for kind in (Waits.SLEEP, Waits.ANSWER, Waits.SERVER):
        other = standing(33, kind, can_end=True)
        assert stands([sample(0, other), sample(7, other)]) is None, 'it is for others to end it'
    timed = replace(waits, wait=Wait(Waits.EVENT, timed=True))
    assert stands([sample(0, timed), sample(7, timed)]) is None


def test_a_path_that_leads_nowhere_is_shown_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    paths = {'': '', '/opt/arm.py': '/opt/arm.py', str(tmp_path / 'arm.py'): 'arm.py'}
    assert {path: shown_path(path) for path in paths} == paths
    gone = tmp_path / 'gone'
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    assert shown_path('arm.py') == 'arm.py'
