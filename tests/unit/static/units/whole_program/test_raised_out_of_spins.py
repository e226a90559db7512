"""
Who waits for callbacks of a thread that spins, where one of them raises out of the spin.

Measured with rclpy 7.1.6 and 9.1.2: timers, subscriptions, services, guard conditions and
done-callbacks, on one thread and on a pool. ``SystemExit`` does not rise out of a pool.
"""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import queue
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node


class Parser(Node):
    def __init__(self):
        super().__init__('parser')
        self.lines = queue.Queue()
        self.create_timer(0.2, self.parse)

    def parse(self):
        line = read()
        if not line:
            raise ValueError('bad line')
        self.lines.put(line)


def spin(executor):
    executor.spin()


def main():
    rclpy.init()
    node = Parser()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=spin, args=(executor,), daemon=True).start()
    while rclpy.ok():
        node.lines.get()


main()
"""
RAISES = "            raise ValueError('bad line')\n"
CATCHES = f'            try:\n    {RAISES}            except ValueError:\n                return\n'
SPINS = '    executor.spin()\n'
TRIES = f'    try:\n    {SPINS}    except ValueError:\n        executor.spin()\n'
GETS = '    while rclpy.ok():\n        node.lines.get()\n'
START = '    threading.Thread(target=spin, args=(executor,), daemon=True).start()\n'
TAKES = f'    threading.Thread(target=take, args=(node,)).start()\n{SPINS}'
TAKER = f'def take(node):\n{GETS}\n\ndef main'


def why_open(program: str) -> str | None:
    activities = [activity for unit in scan_text(program).units for activity in unit.activities]
    waits = [b for a in activities for b in a.blocking if b.call == 'Queue.get']
    (why,) = {block.escapes.reason if block.escapes else None for block in waits}
    return why


@pytest.mark.parametrize('executor', ['SingleThreadedExecutor', 'MultiThreadedExecutor'])
def test_what_a_callback_raises_ends_the_thread_that_spins(executor: str) -> None:
    program = PROGRAM.replace('executor = SingleThreadedExecutor', f'executor = {executor}')
    assert why_open(program) == 'parse raises ValueError, which ends the thread that spins'


@pytest.mark.parametrize(
    ('text', 'other'),
    [
        (RAISES, '            return\n'),
        (
            RAISES,
            f'            try:\n    {RAISES}            except ValueError:\n{" " * 16}return\n',
        ),
        (RAISES, RAISES.replace("ValueError('bad line')", 'NotImplementedError')),
        (SPINS, TRIES),
    ],
    ids=['it does not', 'it is caught', 'of a base class', 'the spin is tried'],
)
def test_else_it_goes_on(text: str, other: str) -> None:
    assert text in PROGRAM
    assert why_open(PROGRAM.replace(text, other)) is None


def test_where_main_spins_the_program_ends_with_it() -> None:
    program = PROGRAM.replace(START + GETS, TAKES).replace('def main', TAKER)
    assert why_open(program) is None


def test_an_exit_rises_out_of_one_thread_alone() -> None:
    program = PROGRAM.replace(RAISES, '            raise SystemExit\n')
    assert why_open(program) == 'parse raises SystemExit, which ends the thread that spins'
    assert why_open(program.replace('executor = Single', 'executor = Multi')) is None
