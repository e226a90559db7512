"""What a program makes again and again stays one entry; what it has side by side stays apart."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from itertools import count
from types import SimpleNamespace
from typing import Any

import pytest

from ros2cc_extract.extract.live.recorder import entries
from ros2cc_extract.extract.live.recorder.events import BEGIN, END
from ros2cc_extract.extract.live.recorder.frames import Creation
from ros2cc_extract.extract.live.recorder.record import Recorder

LINE = ('robot.py', 10, 5)


class Group:
    """As much of a callback group as is looked at."""


class Entity:
    """As much of a timer, a guard condition … as is looked at."""

    def __init__(self, group: Group) -> None:
        self.callback_group = group
        self.callback = None


class Node:
    """As much of a node as is looked at; what it holds ends with it."""

    default_callback_group: Any = None
    timers: tuple[Entity, ...] = ()
    subscriptions = guards = clients = services = waitables = ()

    def __init__(self, name: str) -> None:
        self.name = name
        self.default_callback_group = Group()

    def get_name(self) -> str:
        return self.name

    def get_namespace(self) -> str:
        return '/'


class Executor:
    """Has always waited."""


@pytest.fixture(autouse=True)
def _clock(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Count the calls instead of the time."""
    ticks = count(1)
    monkeypatch.setattr(entries, 'time', SimpleNamespace(monotonic_ns=lambda: next(ticks)))
    return iter(())


def made_by(recorder: Recorder, executor: Executor, name: str, *places: int) -> Node:
    """Make a node with a timer at each of these lines, in an executor made by one line."""
    node = Node(name)
    recorder.note_executor(executor, LINE)
    group = node.default_callback_group
    recorder.note_group(group, Creation(place=LINE))
    node.timers = tuple(Entity(group) for _ in places)
    for timer, line in zip(node.timers, places, strict=True):
        recorder.note_entity(group, timer, Creation(place=('robot.py', line, 9), node=node))
    recorder.note_added(executor, node)
    return node


def settled(recorder: Recorder) -> tuple[int, int, int, int]:
    gc.collect()
    recorder.look_around()
    recorder.settle()
    return (
        len(recorder.all_executors),
        len(recorder.all_nodes),
        len(recorder.all_groups),
        len(recorder.all_entities),
    )


def test_node_that_comes_and_goes_has_one_stay_as_long_as_all_of_them() -> None:
    recorder, executor, node = Recorder(), Executor(), Node('arm')
    for _ in range(5):
        recorder.note_added(executor, node)
        recorder.note_removed(executor, node)
        for _ in range(10):
            entries.time.monotonic_ns()
    (stay,) = recorder.note_node(node).stays
    assert (stay.until or 0) - stay.since == 5
    changes = recorder.changes
    recorder.note_added(executor, node)
    assert recorder.changes == changes


def test_nodes_and_executors_made_one_after_the_other_are_one() -> None:
    recorder = Recorder()
    for _ in range(3):
        executor = Executor()
        node = made_by(recorder, executor, 'worker', 20, 21)
        recorder.note_removed(executor, node)
        del executor, node
    assert settled(recorder) == (1, 1, 1, 2)
    assert [entity.made for entity in recorder.all_entities] == [1, 1]
    (stay,) = recorder.all_nodes[0].stays
    assert (stay.until or 0) - stay.since == 3


def test_nodes_of_one_name_side_by_side_stay_apart() -> None:
    recorder = Recorder()
    executors = [Executor(), Executor()]
    nodes = [made_by(recorder, executor, 'worker', 20) for executor in executors]
    for executor, node in zip(executors, nodes, strict=True):
        recorder.note_removed(executor, node)
    del executors, nodes, executor, node
    assert settled(recorder) == (2, 2, 2, 2)


def test_nodes_of_other_names_stay_apart() -> None:
    recorder = Recorder()
    for name in ('left', 'right'):
        executor = Executor()
        node = made_by(recorder, executor, name, 20)
        recorder.note_removed(executor, node)
        del executor, node
    assert settled(recorder) == (1, 2, 2, 2)


def test_what_is_alive_is_not_folded() -> None:
    recorder = Recorder()
    for _ in range(2):
        executor = Executor()
        node = made_by(recorder, executor, 'worker', 20)
        recorder.note_removed(executor, node)
    assert settled(recorder) == (2, 2, 2, 2)
    del executor, node
    assert settled(recorder) == (1, 1, 1, 1)


def test_node_that_nobody_removed_was_served_until_it_ended() -> None:
    recorder = Recorder()
    for _ in range(2):
        executor = Executor()
        made_by(recorder, executor, 'worker', 20)
        del executor
        gc.collect()
    assert settled(recorder) == (1, 1, 1, 1)


def test_groups_that_one_line_makes_for_a_node_stay_apart() -> None:
    recorder, executor = Recorder(), Executor()
    for _ in range(2):
        node = made_by(recorder, executor, 'worker')
        groups = [Group(), Group()]
        for group in groups:
            recorder.note_group(group, Creation(place=('robot.py', 30, 9)))
        node.timers = tuple(Entity(group) for group in groups)
        for timer in node.timers:
            place = ('robot.py', 31, 9)
            recorder.note_entity(timer.callback_group, timer, Creation(place=place, node=node))
        recorder.note_removed(executor, node)
        del node, groups, group, timer
    assert settled(recorder) == (1, 1, 2, 2)
    first, second = recorder.all_entities
    assert first.group != second.group


def test_runs_of_what_was_made_again_are_counted_together() -> None:
    recorder, executor = Recorder(), Executor()
    for start in (100, 200):
        node = made_by(recorder, executor, 'worker', 20)
        number = recorder.all_entities[-1].number
        for clock, what in ((start, BEGIN), (start + 7, END)):
            recorder.journal.put(clock, 1, what, number)
        recorder.note_removed(executor, node)
        del node
    recorder.take_events()
    settled(recorder)
    (timer,) = recorder.all_entities
    assert (timer.timings.runs, timer.timings.durations.count) == (2, 2)
    assert timer.timings.periods.count == 0


def test_tasks_of_executors_made_again_are_one() -> None:
    recorder = Recorder()
    for _ in range(2):
        executor = Executor()
        node = made_by(recorder, executor, 'worker', 20)
        recorder.note_task(executor, 'task', settled)
        recorder.note_removed(executor, node)
        del executor, node
    settled(recorder)
    (task,) = recorder.tasks.values()
    assert (task.count, task.executor) == (2, recorder.all_executors[0].number)


def test_trace_keeps_every_number_it_has_told() -> None:
    recorder = Recorder(traced=True)
    for _ in range(2):
        executor = Executor()
        node = made_by(recorder, executor, 'worker', 20)
        recorder.note_removed(executor, node)
        del executor, node
    assert settled(recorder) == (2, 2, 2, 2)


def sleep_once(recorder: Recorder, node: Node) -> Entity:
    """Make a timer in a group of its own, as a coroutine does that sleeps by one."""
    group = Group()
    recorder.note_group(group, Creation(place=('sleep.py', 30, 9)))
    timer = Entity(group)
    place = ('sleep.py', 31, 9)
    recorder.note_entity(group, timer, Creation(place=place, node=node))
    return timer


def test_timers_made_again_with_a_group_of_their_own_are_one() -> None:
    recorder, executor = Recorder(), Executor()
    node = made_by(recorder, executor, 'worker', 20)
    for _ in range(5):
        one, other = sleep_once(recorder, node), sleep_once(recorder, node)
        del one, other
        gc.collect()
        settled(recorder)
    assert settled(recorder) == (1, 1, 3, 3)
    assert [entity.made for entity in recorder.all_entities] == [1, 5, 5]


def test_timers_with_groups_that_were_there_at_a_time_stay_apart() -> None:
    recorder, executor = Recorder(), Executor()
    node = made_by(recorder, executor, 'worker')
    timers = [sleep_once(recorder, node) for _ in range(3)]
    del timers
    assert settled(recorder) == (1, 1, 4, 3)
