"""Runs to a standstill, cut down to what shows it."""

from __future__ import annotations

from ros2cc_extract.findings.waits.hangs import show_hang
from ros2cc_extract.verify.results.events import Event
from ros2cc_extract.verify.results.evidence import Evidence, Moment, Sentence

CALL = """\
executor: arrival who=on_map
timer: due who=drive
executor: wake executor=executor
executor: queue by=executor who=on_map
executor: queue by=executor who=drive
thread_0: take thread=thread_0 who=on_map
thread_0: start who=on_map thread=thread_0
thread_0: end who=on_map thread=thread_0
thread_0: take thread=thread_0 who=drive
thread_0: start who=drive thread=thread_0
thread_0: wait who=drive thread=thread_0 needed=client
source: arrival who=on_map
source: due who=other
executor: wake executor=executor
executor: queue by=executor who=on_map
thread_1: take thread=thread_1 who=on_map
thread_1: start who=on_map thread=thread_1
thread_1: end who=on_map thread=thread_1
source: arrival who=client
"""
GROUPS = {'drive': 'default', 'client': 'default', 'on_map': 'maps'}
ABOUT = {'drive', 'client', 'on_map'}
THREADS = ('thread_0', 'thread_1')


def event_of(text: str) -> Event:
    """Kind, form and fields of an event, as in ``wait lock who=drive``."""
    words = text.split()
    kind, *form = [word for word in words if '=' not in word]
    fields = dict(word.split('=') for word in words if '=' in word)
    return Event(kind=kind, form=' '.join(form), **fields)  # type: ignore[arg-type]


def run_of(text: str) -> Evidence:
    lines = [line.split(': ', 1) for line in text.splitlines()]
    return Evidence(
        start={},
        moments=tuple(
            Moment(
                number=number,
                sentences=(Sentence.of(lane, event_of(said)),),
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
source: due who=left
source: due who=right
executor: wake executor=executor
thread_0: start who=left thread=thread_0
thread_0: wait who=left thread=thread_0 needed=left_client
thread_1: start who=right thread=thread_1
thread_1: wait who=right thread=thread_1 needed=right_client
source: arrival who=on_plan
"""
    run = show_hang(run_of(text), {'left', 'left_client'}, {'left': 'a', 'right': 'b'}, THREADS)
    assert told(run) == told(run_of(text))[:7]
    assert run.closing == (
        'nothing moves any more: left waits on thread_0 for left_client; '
        'right waits on thread_1 for right_client; no thread is left'
    )


BOTH_WAIT = """\
source: due who=left
source: due who=right
thread_0: start who=left thread=thread_0
thread_0: wait who=left thread=thread_0 needed=left_client
thread_1: start who=right thread=thread_1
thread_1: wait who=right thread=thread_1 needed=right_client
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
source: arrival who=gate
thread_0: start who=gate thread=thread_0
thread_0: wait who=gate thread=thread_0 needed=first
thread_0: go_on who=gate
thread_0: await who=gate needed=second thread=thread_0
"""
    groups = {'gate': 'a', 'second': 'a'}
    run = show_hang(run_of(text), {'gate', 'second'}, groups, ('thread_0',))
    assert (told(run), run.left_out) == (told(run_of(text)), 0)
    assert run.closing == 'nothing moves any more: gate awaits second, and keeps group a closed'


def test_only_the_last_run_of_who_waits_is_shown() -> None:
    text = """\
source: arrival who=gate
thread_0: start who=gate thread=thread_0
thread_0: end who=gate thread=thread_0
source: arrival who=gate
thread_0: start who=gate thread=thread_0
thread_0: await who=gate needed=second thread=thread_0
"""
    run = show_hang(run_of(text), {'gate', 'second'}, {}, ('thread_0',))
    assert (told(run), run.left_out) == (told(run_of(text))[3:], 3)


def test_who_spins_while_it_waits_leaves_its_thread_to_others() -> None:
    text = """\
source: arrival who=gate
thread_0: start who=gate thread=thread_0
thread_0: spin who=gate executor=executor thread=thread_0 needed=second
"""
    groups = {'gate': 'a', 'second': 'a'}
    run = show_hang(run_of(text), {'gate', 'second'}, groups, ('thread_0',))
    assert run.closing == (
        'nothing moves any more: gate spins on thread_0 for second, and keeps group a closed'
    )


def test_who_waits_for_a_lock_waits_for_its_holder() -> None:
    text = """\
source: arrival who=gate
thread_0: start who=gate thread=thread_0
thread_0: await who=gate needed=second thread=thread_0
source: arrival who=door
thread_0: start who=door thread=thread_0
thread_0: wait lock who=door thread=thread_0 needed=gate
"""
    run = show_hang(run_of(text), {'door'}, {}, ('thread_0', 'thread_1'))
    assert run.closing == (
        'nothing moves any more: gate awaits second; door waits on thread_0 for the lock of gate'
    )


def test_a_run_in_which_nobody_hangs_is_left_as_it_is() -> None:
    run = run_of('source: arrival who=gate\nthread_0: start who=gate thread=thread_0\n')
    assert show_hang(run, {'gate'}, {}, ('thread_0',)) is run
