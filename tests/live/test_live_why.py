"""``why`` names what hangs in a real process, and says no false word of what goes on."""

from __future__ import annotations

import itertools
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest
from interpreters import INTERPRETER_VARIABLE, KILTED_VARIABLE, interpreter_of

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live import injection, why
from ros2cc_extract.extract.live.environment import hooked_environment
from ros2cc_extract.extract.live.hang_analysis.formats import as_text
from ros2cc_extract.extract.live.why import explain_process
from ros2cc_extract.hang_proof import judge
from ros2cc_extract.hang_proof.judge import judged
from tests.live.standing import cells_at_once, program, told
from tests.support.cells import all_cells

AT_ONCE = 5
CELLS = {cell.name: cell for cell in all_cells()}
EXPECTED = {
    'call_own_group_multi': ('deadlock', [('ask', 20, 'CC101')]),
    'call_other_group_single': ('deadlock', [('ask', 23, 'CC102')]),
    'call_other_group_multi': ('idle and healthy', []),
    'call_on_one_worker_multi': ('deadlock', [('ask', 23, 'CC103')]),
    'call_service_of_own_group_multi': ('deadlock', [('ask', 23, 'CC101')]),
    'await_own_group_multi': ('deadlock', [('ask', 20, 'CC104')]),
    'await_other_group_multi': ('idle and healthy', []),
    'rate_single': ('deadlock', [('ask', 18, 'CC105')]),
    'event_own_group_multi': ('deadlock', [('ask', 20, 'CC109')]),
    'absent_service_multi': ('waits for another process', []),
    'send_goal_own_group_multi': ('deadlock', [('ask', 21, 'CC101')]),
    'send_goal_other_group_single': ('deadlock', [('ask', 24, 'CC102')]),
    'send_goal_other_group_multi': ('idle and healthy', []),
    'await_foreign_thread_single': ('asleep', []),
    'await_foreign_thread_multi': ('asleep', []),
}
OF_EACH_VERDICT = {verdict: name for name, (verdict, _) in reversed(EXPECTED.items())}.values()
"""On the second release these; all of them there by ``make why`` too."""
LOCKS = """
import threading, time
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

class Mux(Node):
    def __init__(self):
        super().__init__('mux')
        self.plan, self.motor = threading.Lock(), threading.Lock()
        for callback in (self.move, self.stop):
            self.create_timer(0.1, callback, callback_group=ReentrantCallbackGroup())

    def move(self):
        with self.plan:
            time.sleep(0.3)
            with self.motor:
                pass

    def stop(self):
        with self.motor:
            time.sleep(0.3)
            print('asks', flush=True)
            with self.plan:
                pass

rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Mux())
executor.spin()
"""
SAME_ORDER = LOCKS.replace(
    'with self.motor:\n            time', 'with self.plan:\n            time'
).replace('flush=True)\n            with self.plan', 'flush=True)\n            with self.motor')


@pytest.fixture(autouse=True)
def _patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a busy machine an answer takes longer than a user is to wait."""
    for module in (injection, why):
        monkeypatch.setattr(module, 'PATIENCE_S', 60.0)
    monkeypatch.setattr(judge, 'SECONDS', 60.0)


def batches(names: Iterable[str]) -> Iterator[tuple[str, ...]]:
    """So many as run side by side."""
    left = iter(names)
    return iter(lambda: tuple(itertools.islice(left, AT_ONCE)), ())


@pytest.mark.parametrize(
    ('variable', 'names'),
    [
        *((INTERPRETER_VARIABLE, names) for names in batches(EXPECTED)),
        *((KILTED_VARIABLE, names) for names in batches(OF_EACH_VERDICT)),
        *(
            pytest.param(KILTED_VARIABLE, names, marks=pytest.mark.slow)
            for names in batches(name for name in EXPECTED if name not in OF_EACH_VERDICT)
        ),
    ],
)
def test_processes_are_explained(variable: str, names: tuple[str, ...]) -> None:
    said, proven = {}, set()
    cells = [CELLS[name] for name in names]
    with cells_at_once(interpreter_of(variable), cells) as processes:
        for name, process in zip(names, processes, strict=True):
            explanation = judged(explain_process(process.pid))
            said[name] = told(explanation)
            proven |= {name} if explanation.proof == 'proven by the model' else set()
            assert process.poll() is None
    assert said == {name: EXPECTED[name] for name in names}
    assert proven == {name for name in names if EXPECTED[name][0] == 'deadlock'}


@pytest.mark.parametrize('traced', [False, True])
def test_hooked_processes_are_explained_alike(
    traced: bool, rclpy_python: str, tmp_path: Path
) -> None:
    """The thread of the hook is none of the program's: it ends no wait."""
    names = ('event_own_group_multi', 'call_other_group_single', 'await_other_group_multi')
    hooked = hooked_environment({}, tmp_path, traced=traced)
    cells = [CELLS[name] for name in names]
    with cells_at_once(rclpy_python, cells, **hooked) as processes:
        for name, process in zip(names, processes, strict=True):
            assert told(explain_process(process.pid)) == EXPECTED[name], name
    assert len(list(tmp_path.glob('*.json'))) == len(names)


def test_locks_that_wait_for_each_other_are_a_deadlock(rclpy_python: str) -> None:
    with program(rclpy_python, LOCKS, Path('locks.py')) as process:
        explanation = judged(explain_process(process.pid))
    verdict, stand = told(explanation)
    assert explanation.proof == 'proven by the model'
    both = {(function, code) for function, _, code in stand}
    assert (verdict, both) == ('deadlock', {('move', 'CC111'), ('stop', 'CC111')})


def test_lock_of_a_statement_with_two_is_named(rclpy_python: str) -> None:
    """Until Python 3.11 both stand at the same place."""
    nested = 'with self.plan:\n            time.sleep(0.3)\n            with self.motor:'
    one = 'with self.plan, self.slow(), self.motor:'
    slow = """    @contextlib.contextmanager
    def slow(self):
        time.sleep(0.3)
        yield

    def move"""
    text = LOCKS.replace(nested, one).replace('    def move', slow)
    text = 'import contextlib\n' + text.replace('                pass', '            pass', 1)
    with program(rclpy_python, text, Path('locks.py')) as process:
        explanation = judged(explain_process(process.pid))
    verdict, stand = told(explanation)
    assert explanation.proof == 'proven by the model'
    both = {(function, code) for function, _, code in stand}
    assert (verdict, both) == ('deadlock', {('move', 'CC111'), ('stop', 'CC111')})


def test_locks_in_one_order_are_none(rclpy_python: str) -> None:
    with program(rclpy_python, SAME_ORDER, Path('locks.py')) as process:
        assert told(explain_process(process.pid))[1] == []


def test_process_without_nodes_is_told() -> None:
    command = [sys.executable, '-c', 'import time\nprint(flush=True)\ntime.sleep(60)']
    with subprocess.Popen(command, stdout=subprocess.PIPE) as other:
        try:
            assert other.stdout is not None
            other.stdout.readline()
            with pytest.raises(InputError, match=f'process {other.pid} has no rclpy node'):
                explain_process(other.pid)
        finally:
            other.kill()


TAKEN_OUT = """
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

class Wheels(Node):
    def __init__(self):
        super().__init__('wheels')
        self.laps = 0
        self.create_timer(0.1, self.turn)

    def turn(self):
        self.laps += 1
        print('asks', flush=True)
        ONCE

rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Wheels())
executor.spin()
"""


@pytest.mark.parametrize(
    ('once', 'verdict'),
    [
        ('rclpy.spin_once(self, timeout_sec=0.01)', 'in no executor'),
        ('pass', 'idle and healthy'),
    ],
)
def test_node_that_was_taken_out_of_its_executor(
    once: str, verdict: str, rclpy_python: str
) -> None:
    with program(rclpy_python, TAKEN_OUT.replace('ONCE', once), Path('node.py')) as process:
        explanation = explain_process(process.pid)
    text = as_text((explanation,))
    assert explanation.verdict.value == verdict, text
    lost = '/wheels is in no executor: `rclpy.spin_once` and the like take it out'
    assert (lost in text) is (verdict == 'in no executor')
