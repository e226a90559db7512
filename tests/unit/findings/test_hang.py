"""Runs to a standstill, cut down to what shows it."""

from __future__ import annotations

import re
from pathlib import Path

from ros2cc_extract.findings.hang import show_hang
from ros2cc_extract.verify.evidence import Evidence, Moment, Sentence

PROFILE = Path(__file__).parents[3] / 'generator' / 'profiles' / 'rclpy'
CALL = """\
executor: data arrives for on_map
timer: timer drive is due
executor: executor wakes up: something is ready
executor: executor queues on_map
executor: executor queues drive
thread_0: thread_0 takes on_map from the queue
thread_0: on_map starts on thread_0
thread_0: on_map ends on thread_0
thread_0: thread_0 takes drive from the queue
thread_0: drive starts on thread_0
thread_0: drive waits on thread_0 for client
source: data arrives for on_map
source: timer other is due
executor: executor wakes up: something is ready
executor: executor queues on_map
thread_1: thread_1 takes on_map from the queue
thread_1: on_map starts on thread_1
thread_1: on_map ends on thread_1
source: data arrives for client
"""
GROUPS = {'drive': 'default', 'client': 'default', 'on_map': 'maps'}
ABOUT = {'drive', 'client', 'on_map'}
THREADS = ('thread_0', 'thread_1')


def run_of(text: str) -> Evidence:
    lines = [line.split(': ', 1) for line in text.splitlines()]
    return Evidence(
        start={},
        moments=tuple(
            Moment(
                number=number,
                sentences=(Sentence(lane, said),),
                places=(),
                changes={'step': number, f'of_{lane}': number},
            )
            for number, (lane, said) in enumerate(lines, start=1)
        ),
        cycle_from=None,
        ends='deadlock',
    )


def told(run: Evidence) -> list[str]:
    return [sentence.text for moment in run.moments for sentence in moment.sentences]


def test_the_wait_is_shown_with_what_is_done_for_it_and_without_the_rest() -> None:
    run = show_hang(run_of(CALL), ABOUT, GROUPS, THREADS)
    assert told(run) == [
        'timer drive is due',
        'executor wakes up: something is ready',
        'executor queues drive',
        'thread_0 takes drive from the queue',
        'drive starts on thread_0',
        'drive waits on thread_0 for client',
        'data arrives for on_map',
        'on_map starts on thread_1',
        'on_map ends on thread_1',
        'data arrives for client',
    ]
    assert (run.left_out, run.closing) == (
        9,
        'nothing moves any more: drive waits on thread_0 for client, and keeps group default '
        'closed',
    )


def test_steps_are_numbered_anew_and_have_what_changed_before_them() -> None:
    run = show_hang(run_of(CALL), ABOUT, GROUPS, THREADS)
    assert [moment.number for moment in run.moments] == list(range(1, 11))
    assert run.moments[0].changes == {'step': 2, 'of_executor': 1, 'of_timer': 2}


def test_all_who_wait_are_told_when_no_thread_is_left() -> None:
    text = """\
source: timer left is due
source: timer right is due
executor: executor wakes up: something is ready
thread_0: left starts on thread_0
thread_0: left waits on thread_0 for left_client
thread_1: right starts on thread_1
thread_1: right waits on thread_1 for right_client
source: data arrives for on_plan
"""
    run = show_hang(run_of(text), {'left', 'left_client'}, {'left': 'a', 'right': 'b'}, THREADS)
    assert told(run) == told(run_of(text))[:7]
    assert run.closing == (
        'nothing moves any more: left waits on thread_0 for left_client; '
        'right waits on thread_1 for right_client; no thread is left'
    )


BOTH_WAIT = """\
source: timer left is due
source: timer right is due
thread_0: left starts on thread_0
thread_0: left waits on thread_0 for left_client
thread_1: right starts on thread_1
thread_1: right waits on thread_1 for right_client
"""


def test_another_who_hangs_by_the_way_is_not_told() -> None:
    groups = {'left': 'a', 'left_client': 'a', 'right': 'b', 'right_client': 'b'}
    run = show_hang(run_of(BOTH_WAIT), {'left', 'left_client'}, groups, (*THREADS, 'thread_2'))
    assert told(run) == [
        'timer left is due',
        'left starts on thread_0',
        'left waits on thread_0 for left_client',
    ]
    assert run.closing == (
        'nothing moves any more: left waits on thread_0 for left_client, and keeps group a closed'
    )


def test_who_keeps_the_group_of_what_is_waited_for_is_told_too() -> None:
    groups = {'left': 'a', 'left_client': 'b', 'right': 'b', 'right_client': 'b'}
    run = show_hang(run_of(BOTH_WAIT), {'left', 'left_client'}, groups, (*THREADS, 'thread_2'))
    assert run.closing == (
        'nothing moves any more: left waits on thread_0 for left_client; '
        'right waits on thread_1 for right_client, and keeps group b closed'
    )


def test_an_await_holds_no_thread_and_a_wait_that_ended_is_no_standstill() -> None:
    text = """\
source: data arrives for gate
thread_0: gate starts on thread_0
thread_0: gate waits on thread_0 for first
thread_0: gate goes on
thread_0: gate awaits second and leaves thread_0
"""
    groups = {'gate': 'a', 'second': 'a'}
    run = show_hang(run_of(text), {'gate', 'second'}, groups, ('thread_0',))
    assert (told(run), run.left_out) == (told(run_of(text)), 0)
    assert run.closing == 'nothing moves any more: gate awaits second, and keeps group a closed'


def test_only_the_last_run_of_who_waits_is_shown() -> None:
    text = """\
source: data arrives for gate
thread_0: gate starts on thread_0
thread_0: gate ends on thread_0
source: data arrives for gate
thread_0: gate starts on thread_0
thread_0: gate awaits second and leaves thread_0
"""
    run = show_hang(run_of(text), {'gate', 'second'}, {}, ('thread_0',))
    assert (told(run), run.left_out) == (told(run_of(text))[3:], 3)


def test_who_spins_while_it_waits_leaves_its_thread_to_others() -> None:
    text = """\
source: data arrives for gate
thread_0: gate starts on thread_0
thread_0: gate spins executor on thread_0 for second
"""
    groups = {'gate': 'a', 'second': 'a'}
    run = show_hang(run_of(text), {'gate', 'second'}, groups, ('thread_0',))
    assert run.closing == (
        'nothing moves any more: gate spins on thread_0 for second, and keeps group a closed'
    )


def test_who_waits_for_a_lock_waits_for_its_holder() -> None:
    text = """\
source: data arrives for gate
thread_0: gate starts on thread_0
thread_0: gate awaits second and leaves thread_0
source: data arrives for door
thread_0: door starts on thread_0
thread_0: door waits on thread_0 for the lock of gate
"""
    run = show_hang(run_of(text), {'door'}, {}, ('thread_0', 'thread_1'))
    assert run.closing == (
        'nothing moves any more: gate awaits second; door waits on thread_0 for the lock of gate'
    )


def test_a_run_in_which_nobody_hangs_is_left_as_it_is() -> None:
    run = run_of('source: data arrives for gate\nthread_0: gate starts on thread_0\n')
    assert show_hang(run, {'gate'}, {}, ('thread_0',)) is run


def test_the_words_are_those_of_the_templates() -> None:
    """Whoever rewords an edge has to reword what is looked for in it."""
    comment = re.compile(r'kind="comments"[^>]*>(.*?)</label>')
    said = {
        re.sub(r'\{\w+[^}]*\}', '…', text)
        for template in PROFILE.glob('*.j2')
        for text in comment.findall(template.read_text(encoding='utf-8'))
    }
    assert said == {
        '… answers',
        '… finds that … has run',
        '… has served one callback and goes on',
        '… has spun long enough and goes on',
        '… queues … and stops: its spin raises what a callback raised',
        "… spins … on …{{ ' for …' if form.is_for_callback }}",
        '… spins …, which refuses as it spins already, and raises on …',
        '… starts on …, inside …',
        '… stops: its spin raises what the callback raised',
        "… takes its node out of … and spins it on …{{ ' for …' if form.is_for_callback }}",
        '… waits on … for the lock of …',
        '… waits on … for the service of …, which nobody here offers',
        '… awaits what a thread outside … makes done, and leaves …',
        "a thread outside … makes done what … awaits{{ ', which wakes nobody' "
        'if not unit.foreign_wakes }}',
        '… awaits … and leaves …',
        '… ends on …',
        '… goes on',
        '… goes on, on …',
        '… is refused …: its group is closed',
        '… leaves …: its group is closed',
        '… queues …',
        '… starts on …',
        '… takes … from the queue',
        '… waits on … for …',
        '… wakes up: a task is ready',
        '… wakes up: something is ready',
        'data arrives for …',
        'timer … is due',
    }
