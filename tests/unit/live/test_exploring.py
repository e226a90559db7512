"""Who is chosen, who is held, where, and what of it is an update that was lost."""

from __future__ import annotations

import itertools
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from ros2cc_extract.extract.live.exploring import policies
from ros2cc_extract.extract.live.exploring.activities import function_of
from ros2cc_extract.extract.live.exploring.control import Control
from ros2cc_extract.extract.live.exploring.marks import Mark, Marks, Point
from ros2cc_extract.extract.live.exploring.policies import Policy, Recorded, policy_of
from ros2cc_extract.extract.live.exploring.tracing import Tracing

PROGRAM = """\
def tell():
    pass


class Counter:
    count = 0

    def add(self):
        before = self.count
        tell()
        self.count = before + 1

    def add_at_once(self):
        self.count += 1

    def reset(self):
        self.count = 0

    def tell_once(self):
        if self.count:
            tell()
            tell()
"""
READ, WRITE, AT_ONCE, RESET, TEST = 9, 11, 14, 17, 20


class Choice:
    """Somebody who may go on."""

    def __init__(self, key: str, at: str = 'begin') -> None:
        self.key = key
        self.at = at


class Group:
    """As of rclpy."""

    def can_execute(self, _entity: Any) -> bool:
        return True


class Timer:
    """As of rclpy; its callback is one of the program."""

    callback_group = Group()

    def __init__(self, name: str) -> None:
        def callback() -> None:
            """What it runs."""

        callback.__qualname__ = name
        callback.__module__ = 'program'
        self.callback = callback


def order(policy: Policy, waiting: dict[str, int]) -> list[str]:
    """Let everybody take so many steps; give who took each."""
    left, taken = dict(waiting), []
    while any(left.values()):
        chosen = policy.choose(
            [Choice(key) for key in sorted(left) if left[key]], taken[-1] if taken else ''
        )
        assert chosen is not None
        left[chosen.key] -= 1
        taken.append(chosen.key)
    return taken


def of(policy: str, seed: int, **more: Any) -> Policy:
    return policy_of({'policy': policy, 'seed': seed, 'number': 1, **more})


def switches(taken: list[str]) -> int:
    return sum(a != b for a, b in itertools.pairwise(taken))


@pytest.mark.parametrize('policy', ['pct', 'random', 'preemptions'])
def test_a_seed_gives_the_same_order_again_and_seeds_differ(policy: str) -> None:
    waiting = {'a#1': 4, 'b#1': 4, 'c#1': 4}
    found = [order(of(policy, seed, depth=3, steps=12), waiting) for seed in range(20)]
    assert found == [order(of(policy, seed, depth=3, steps=12), waiting) for seed in range(20)]
    assert len(set(map(tuple, found))) > 5


def test_priorities_of_depth_d_fall_at_most_d_minus_1_times() -> None:
    """Without a fall the highest priority comes first, up to its end."""
    waiting = {'a#1': 5, 'b#1': 5, 'c#1': 5}
    assert {switches(order(of('pct', seed, depth=1), waiting)) for seed in range(30)} == {2}
    depths = [switches(order(of('pct', seed, depth=3, steps=15), waiting)) for seed in range(60)]
    assert max(depths) == 4 and min(depths) >= 2


def test_few_preemptions_are_few() -> None:
    waiting = {'a#1': 6, 'b#1': 6}
    found = {switches(order(of('preemptions', s, depth=2, steps=12), waiting)) for s in range(60)}
    assert max(found) <= 1 + 2 and len(found) > 1


def test_a_recorded_order_waits_for_who_is_due(monkeypatch: pytest.MonkeyPatch) -> None:
    policy = Recorded([('b#7', 'begin'), ('gone#1', 'begin'), ('a#1', 'x.py:3 wait')])
    early = [Choice('a#2', 'x.py:3 wait')]
    assert policy.choose(early, '') is None
    chosen = policy.choose([*early, Choice('b#1')], '')
    assert chosen is not None and chosen.key == 'b#1'
    assert policy.choose(early, 'b#1') is None
    monkeypatch.setattr(policies, 'PATIENCE_S', 0.0)
    assert policy.choose(early, 'b#1') is early[0]
    assert policy.is_over and policy.left_out == 1


def test_a_recorded_order_may_end_where_one_does_not_come(monkeypatch: pytest.MonkeyPatch) -> None:
    row = {
        'policy': 'recorded',
        'choices': [('b#7', 'begin'), ('gone#1', 'begin'), ('a#1', 'begin')],
    }
    policy = policies.policy_of({**row, 'ends_at_miss': True})
    chosen = policy.choose([Choice('b#1')], '')
    assert chosen is not None and chosen.key == 'b#1' and not policy.is_over
    monkeypatch.setattr(policies, 'PATIENCE_S', 0.0)
    other = Choice('c#1')
    assert policy.choose([other], 'b#1') is other
    assert policy.is_over


def test_what_is_no_policy_is_refused() -> None:
    with pytest.raises(ValueError, match='fate is no policy'):
        of('fate', 1)


@pytest.fixture
def control() -> Iterator[Control]:
    """Control with a clock, as the conductor is one."""
    found, is_over = Control(), threading.Event()

    def tick() -> None:
        while not is_over.wait(0.004):
            found.look_at_the_clock()

    clock = threading.Thread(target=tick)
    clock.start()
    yield found
    is_over.set()
    clock.join()
    found.let_go()


def runs(control: Control, timer: Timer, work: Callable[[], None]) -> threading.Thread:
    """A thread that asks until its callback may begin, as an executor does."""

    def run() -> None:
        while not control.may_begin(timer):
            time.sleep(0.001)
        control.begun(timer)
        work()
        control.ended(timer)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    return thread


def test_callbacks_go_on_in_the_order_of_the_schedule(control: Control) -> None:
    done: list[str] = []
    frame: Any = None

    def steps(name: str) -> Callable[[], None]:
        def work() -> None:
            for at in '12':
                control.pause(at, frame)
                done.append(name + at)

        return work

    asked = [('b (timer)#1', 'begin'), ('b (timer)#1', '1'), ('a (timer)#1', 'begin')]
    asked += [('a (timer)#1', '1'), ('a (timer)#1', '2'), ('b (timer)#1', '2')]
    control.take(Recorded(asked), 0.0)
    threads = [runs(control, Timer(name), steps(name)) for name in 'ab']
    for thread in threads:
        thread.join(10)
    assert done == ['b1', 'a1', 'a2', 'b2']
    assert control.choices == asked
    assert control.is_quiet and control.begins == 2


def test_who_really_waits_is_not_waited_for(control: Control) -> None:
    """Else a lock that is held by somebody who is held would look like a hang."""
    event = threading.Event()
    control.take(policy_of({'policy': 'pct', 'seed': 5, 'depth': 1}), 0.05)
    first = runs(control, Timer('waits'), lambda: event.wait(20))
    second = runs(control, Timer('sets'), event.set)
    first.join(10)
    second.join(10)
    assert not first.is_alive() and not second.is_alive()


def test_nobody_is_held_when_control_is_given_up(control: Control) -> None:
    control.take(Recorded([('somebody else#1', 'begin')] * 50), 0.0)
    thread = runs(control, Timer('a'), lambda: None)
    thread.join(0.2)
    assert thread.is_alive()
    control.let_go()
    thread.join(10)
    assert not thread.is_alive()


def test_a_callback_of_rclpy_is_never_held(control: Control) -> None:
    control.hold_all()
    timer = Timer('own')
    assert not control.may_begin(timer)
    timer.callback.__module__ = 'rclpy.parameter_service'
    assert control.may_begin(timer)


@pytest.fixture
def program(tmp_path: Path) -> Any:
    path = tmp_path / 'program.py'
    path.write_text(PROGRAM, encoding='utf-8')
    module = ModuleType('program')
    exec(compile(PROGRAM, str(path), 'exec'), module.__dict__)
    return module


def points(program: Any, *lines: int) -> list[Point]:
    file = program.Counter.add.__code__.co_filename
    return [
        Point({'file': file, 'line': n, 'kind': 'access', 'name': 'Counter.count', 'rests': True})
        for n in lines
    ]


def tracing_of(program: Any, control: Control, tell: Callable[..., None]) -> Tracing:
    return Tracing(Marks(points(program, READ, WRITE, AT_ONCE, RESET, TEST)), control, tell)


def traced(tracing: Tracing, work: Callable[[], None]) -> threading.Thread:
    """Run something in a thread that is traced."""

    def run() -> None:
        tracing.start()
        try:
            work()
        finally:
            tracing.stop()

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    return thread


def test_marks_name_what_is_done_there(program: Any) -> None:
    found = Marks(points(program, READ, WRITE)).of(program.Counter.add.__code__).marks
    assert [mark.at for _, mark in sorted(found.items())] == [
        f'program.py:{READ} read Counter.count',
        f'program.py:{WRITE} write Counter.count',
    ]
    assert Marks(points(program, READ)).of(program.tell.__code__).marks == {}


def test_an_update_that_another_thread_has_replaced_is_lost(
    program: Any, control: Control
) -> None:
    counter, lost = program.Counter(), []

    def tell(mark: Mark, **values: Any) -> None:
        lost.append((mark.line, values))

    add, reset = (function_of(f.__code__) for f in (counter.add, counter.reset))
    control.take(
        Recorded(
            [
                (add, f'program.py:{READ} read Counter.count'),
                (reset, f'program.py:{RESET} write Counter.count'),
                (add, f'program.py:{WRITE} write Counter.count'),
            ]
        ),
        0.0,
    )
    counter.count = 5
    tracing = tracing_of(program, control, tell)
    threads = [traced(tracing, work) for work in (counter.add, counter.reset)]
    for thread in threads:
        thread.join(10)
    assert counter.count == 6
    values = {'read': '5', 'other': '0', 'own': '6', 'read_line': READ}
    assert lost == [(WRITE, values)]


def test_one_after_the_other_loses_nothing(program: Any, control: Control) -> None:
    counter, lost = program.Counter(), []

    def tell(mark: Mark, **values: Any) -> None:
        lost.append(values)

    tracing = tracing_of(program, control, tell)
    for work in (counter.add, counter.reset, counter.add, counter.add_at_once):
        traced(tracing, work).join(10)
    assert (counter.count, lost) == (2, [])


def test_where_no_thread_can_come_in_nobody_is_held(program: Any, control: Control) -> None:
    """`+=` on a number is one piece for CPython with its global lock."""
    counter, stood = program.Counter(), []
    control.pause = lambda at, frame: stood.append(at)  # type: ignore[method-assign]
    tracing = tracing_of(program, control, lambda *_, **__: None)
    for work in (counter.add_at_once, counter.add):
        traced(tracing, work).join(10)
    assert stood == [
        f'program.py:{AT_ONCE} read Counter.count',
        f'program.py:{READ} read Counter.count',
        f'program.py:{WRITE} write Counter.count',
    ]


def test_who_has_tested_is_held_once_before_it_acts(program: Any, control: Control) -> None:
    counter, stood = program.Counter(), []
    counter.count = 1
    control.pause = lambda at, frame: stood.append(at)  # type: ignore[method-assign]
    traced(tracing_of(program, control, lambda *_, **__: None), counter.tell_once).join(10)
    assert stood == [
        f'program.py:{TEST} read Counter.count',
        f'program.py:{TEST} tested Counter.count',
    ]


def test_what_goes_wrong_in_the_trace_does_not_reach_the_program(
    program: Any, control: Control
) -> None:
    def fail(at: str, code: Any) -> None:
        raise RuntimeError('of ours')

    counter = program.Counter()
    control.pause = fail  # type: ignore[method-assign]
    tracing = tracing_of(program, control, lambda *_, **__: None)
    traced(tracing, counter.add).join(10)
    tracing.marks = None  # type: ignore[assignment]
    traced(tracing, counter.add).join(10)
    assert counter.count == 2
