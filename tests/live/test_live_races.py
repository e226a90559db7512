"""
Two races of ``tests/bugs`` happen on real rclpy, each time; in the mended twins they do not.

The second callback runs while the first stands between question and effect (``meeting.py``).
What is found in their sources is compared in ``tests/bugs/test_bugs.py``.
"""

from __future__ import annotations

from pathlib import Path

from side_by_side import PATIENCE_S, Program, RunForked

BUGS = Path(__file__).parents[1] / 'bugs'
GIVES_IN_S = 0.4
Lines = list[str]


def program(stem: str, first: str, second: str, held: tuple[str, str], *awaited: str) -> Program:
    """
    Give the program in which the two meet.

    :param held: what the first one does in between, and the same where it is held.
    """
    path = BUGS / f'{stem}.py'
    text = path.read_text(encoding='utf-8')
    for old, new in (held, ('executor.spin()', 'meeting.spin(executor)')):
        assert text.count(old) == 1, f'{stem} has changed'
        text = text.replace(old, new)
    gives_in_s = GIVES_IN_S if stem.endswith('_mended') else PATIENCE_S
    return Program(
        name=stem,
        path=str(path),
        text=f'import meeting\nmeeting.meet({first!r}, {second!r}, {gives_in_s})\n{text}',
        patience_s=PATIENCE_S,
        awaited=awaited,
    )


def run_both(run_forked: RunForked, stem: str, *rest: object) -> tuple[Lines, Lines]:
    """What the bug and its twin say."""
    stems = (stem, f'{stem}_mended')
    told = run_forked(program(each, *rest) for each in stems)  # type: ignore[arg-type]
    return told[stems[0]], told[stems[1]]


def test_an_arm_moves_after_it_was_stopped(run_forked: RunForked) -> None:
    held = ('speed = goal_handle.request.order', 'speed = hold(goal_handle.request.order)')
    bug, mended = run_both(
        run_forked,
        'g1_stop_written_over',
        'send move',
        'call stop',
        held,
        'both are over',
        '.*arm]: .*',
        '.*arm]: .*',
    )
    # What the first drive says may be from before.
    assert bug[-1].endswith('arm]: moving at 5'), bug
    assert mended[-1].endswith('arm]: stopped'), mended


def test_an_attribute_is_none_when_it_is_used_though_it_was_tested(run_forked: RunForked) -> None:
    held = ('{len(self.path)} points', '{hold("")}{len(self.path)} points')
    end = 'both are over|spin raised .*'
    bug, mended = run_both(
        run_forked, 'g1_none_between_test_and_use', 'call follow', 'send plan', held, end
    )
    assert bug[-1] == "spin raised TypeError: object of type 'NoneType' has no len()", bug
    assert mended[-1] == 'both are over', mended
