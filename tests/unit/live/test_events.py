"""Events on their way from the recorder to the raw trace."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any

from ros2cc_extract.extract.live.hook.tracefile import TraceFile
from ros2cc_extract.extract.live.recorder.events import BEGIN, END, REFUSED, TAKE, WAIT, pack, rows
from ros2cc_extract.extract.live.recorder.record import LARGEST_BATCH, Recorder


class Group:
    """As much of a callback group as is looked at."""


class Timer:
    """As much of an entity as is looked at; each can be held weakly."""

    callback_group: Any = None
    callback: Any = None


class Executor:
    """Waits for nothing."""


def test_events_are_accounted_for_by_number() -> None:
    recorder, group, timer = Recorder(), Group(), Timer()
    entity = recorder.note_entity(group, timer)
    steps = [(10, BEGIN), (12, TAKE), (15, END), (20, REFUSED), (40, BEGIN)]
    for clock, what in steps:
        recorder.journal.put(clock, 7, what, entity.number)
    assert [fields[:3] for fields, _ in rows(recorder.take_events())] == [
        (clock, 7, what) for clock, what in steps
    ]
    told = entity.timings.describe()
    assert (told['count'], told['refused'], told['running']) == (2, 1, 1)
    assert told['duration']['max_s'] == 0.0
    assert entity.timings.periods.largest == 30


def test_events_of_what_was_folded_away_are_passed_over() -> None:
    recorder = Recorder()
    group = Group()
    numbers = [recorder.note_entity(group, Timer()).number for _ in range(3)]
    recorder.settle()
    (kept,) = recorder.all_entities
    for number in numbers:
        recorder.journal.put(10, 7, BEGIN, number)
    recorder.take_events()
    assert (kept.made, kept.timings.runs) == (3, 1)


def test_batch_is_bounded_and_the_rest_is_left_for_the_next() -> None:
    recorder = Recorder()
    for clock in range(LARGEST_BATCH + 2):
        recorder.journal.put(clock, 7, WAIT, 1)
    sizes = [len(list(rows(recorder.take_events()))) for _ in range(3)]
    assert sizes == [LARGEST_BATCH, 2, 0]


def test_forked_child_gives_no_number_of_its_parent_again() -> None:
    recorder = Recorder()
    executor = Executor()
    inherited = recorder.note_executor(executor).number
    recorder.forget()
    assert recorder.note_executor(executor).number > inherited


def test_only_executor_is_known_while_there_is_no_other() -> None:
    recorder, first, second = Recorder(), Executor(), Executor()
    recorder.sees_every_executor = True
    record = recorder.note_executor(first)
    assert recorder.only_executor is record
    recorder.note_executor(second)
    assert recorder.only_executor is None


def test_only_executor_is_not_trusted_once_something_was_lost() -> None:
    recorder, executor = Recorder(), Executor()
    recorder.sees_every_executor = True
    recorder.note_executor(executor)
    recorder.lose(RuntimeError('maybe another executor'))
    assert recorder.only_executor is None


def test_executor_made_before_the_hook_is_never_the_only_one() -> None:
    recorder, executor = Recorder(), Executor()
    recorder.note_executor(executor)
    assert recorder.only_executor is None


def test_thread_is_named_once_before_its_first_event(tmp_path: Path) -> None:
    here = threading.get_ident()
    file = TraceFile(str(tmp_path / 'raw'))
    file.write(pack(10, here, WAIT, 1))
    file.write(pack(11, here, WAIT, 1) + pack(12, 1, WAIT, 2))
    file.note_loss()
    file.close()
    told = [(what, name) for (_, _, what, _), name in rows((tmp_path / 'raw').read_bytes())]
    main = threading.current_thread().name
    assert told == [(254, main), (WAIT, ''), (254, 'thread 1'), (WAIT, ''), (WAIT, ''), (255, '')]
