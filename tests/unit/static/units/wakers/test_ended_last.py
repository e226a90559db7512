"""What the program does to waits of its threads when its last spin is over."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import TIME, Blocking, Waker

PROGRAM = """
import queue
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Log(Node):
    def __init__(self):
        super().__init__('log')
        self.lines = queue.Queue()
        self.over = threading.Event()
        self.create_subscription(String, 'line', self.heard, 10)

    def heard(self, msg):
        {heard}

def write():
    {write}

rclpy.init()
node = Log()
thread = threading.Thread(target=write)
thread.start()
{spin}
node.over.set()
node.lines.put(None)
thread.join()
"""
SPIN = 'rclpy.spin(node)'
ONCE = 'while rclpy.ok():\n    rclpy.spin_once(node)'
UNTIL = 'rclpy.spin_until_future_complete(node, rclpy.Future())'
FIRST = f'{UNTIL}\nnode.over.set()\nnode.lines.put(None)\n{SPIN}'
INSIDE = f'{ONCE}\n    node.over.set()\n    node.lines.put(None)'
POOL = """
executor = MultiThreadedExecutor(2)
executor.add_node(node)
while rclpy.ok():
    executor.spin_once()"""


def _wait(*, heard: str, write: str, spin: str) -> tuple[Blocking, int]:
    text = PROGRAM.format(heard=heard, write=write, spin=spin)
    (unit,) = scan_text(text).units
    doers = [*unit.callbacks, *unit.activities]
    (wait,) = (block for doer in doers for block in doer.blocking)
    return wait, text.count('\n', 0, text.rindex('node.over.set')) + 1


@pytest.mark.parametrize('spin', [SPIN, ONCE, UNTIL])
@pytest.mark.parametrize(('write', 'after'), [('node.over.wait()', 0), ('node.lines.get()', 1)])
def test_what_the_end_of_the_program_ends(spin: str, write: str, after: int) -> None:
    wait, line = _wait(heard='pass', write=write, spin=spin)
    assert wait.at_end is not None
    assert (wait.wakers, wait.escapes, wait.at_end.line) == ((), None, line + after)


@pytest.mark.parametrize('spin', [SPIN, ONCE, UNTIL])
def test_a_callback_waits_for_it_in_vain(spin: str) -> None:
    wait, _ = _wait(heard='self.over.wait()', write='pass', spin=spin)
    assert (wait.wakers, wait.escapes, wait.at_end) == ((), None, None)


@pytest.mark.parametrize('spin', [FIRST, INSIDE, POOL])
def test_what_may_come_while_callbacks_run_is_there(spin: str) -> None:
    wait, _ = _wait(heard='self.over.wait()', write='pass', spin=spin)
    assert [waker.by for waker in wait.wakers] == [TIME] * len(wait.wakers) != []


@pytest.mark.parametrize('spin', [SPIN, ONCE])
def test_who_is_joined_behind_the_spin_runs_beside_it(spin: str) -> None:
    text = PROGRAM.format(heard='pass', write='node.over.wait()', spin=spin)
    (unit,) = scan_text(text).units
    (thread,) = unit.activities
    assert not thread.ends_first


def test_a_callback_that_ends_it_too_is_named() -> None:
    wait, line = _wait(heard='self.over.set()', write='node.over.wait()', spin=SPIN)
    assert [waker.by for waker in wait.wakers] == ['heard']
    assert wait.at_end == Place(wait.at_end.file if wait.at_end else '', line, 1)
    assert wait.wakers == (Waker(by='heard', after=0, source=wait.wakers[0].source),)
