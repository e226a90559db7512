"""``main`` runs callbacks itself, beside a thread that spins another node."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import threading
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool, Int32

class Brake(Node):
    def __init__(self):
        super().__init__('brake')
        self.level = 0
        self.asked = None
        self.create_subscription(Int32, 'level', self.on_level, 1)

    def on_level(self, msg):
        CALLBACK

def serve(node):
    rclpy.spin_once(node, timeout_sec=0.1)
    return 1

def work(node):
    MAIN

def main():
    rclpy.init()
    brake = Brake()
    watcher = Node('watcher')
    watcher.create_subscription(Bool, 'seen', lambda msg: print(msg), 1)
    executor = SingleThreadedExecutor()
    executor.add_node(watcher)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    brake.get_logger().info('ready')
    while rclpy.ok():
        work(brake)

if __name__ == '__main__':
    main()
"""
STORE = 'self.level = msg.data'
COUNT = 'self.level += 1'
ASK = 'if self.level > 1:\n            self.level = msg.data'
CLEAR = 'self.asked = None'


def races(main: str, callback: str, *, by_thread: str = 'brake.get_name()\n') -> list[str]:
    text = PROGRAM.replace('MAIN', main.replace('\n', '\n    ')).replace('CALLBACK', callback)
    text = text.replace("brake.get_logger().info('ready')\n", by_thread)
    units = scan_text(text).units
    found = findings_of(units, [], [None] * len(units))
    return sorted({each.code for each in found if each.code.startswith('CC3')})


@pytest.mark.parametrize('callback', [STORE, COUNT, ASK])
@pytest.mark.parametrize(
    'main',
    [
        'serve(node)\nnode.level = 0',
        'node.level = 0\nserve(node)',
        'serve(node)\nnode.level += 1',
        'print(node.level)\nserve(node)\nnode.level += 1',
        'serve(node)\nif node.level > 3:\n    node.level = 0',
    ],
)
def test_no_callback_comes_in_between_two_spins(main: str, callback: str) -> None:
    assert races(main, callback) == []


@pytest.mark.parametrize('callback', [STORE, COUNT])
@pytest.mark.parametrize(
    'main',
    [
        'level = node.level\nserve(node)\nnode.level = level + 1',
        'if node.level > 3:\n    serve(node)\n    node.level = 0',
        'node.level = node.level + serve(node)',
    ],
)
def test_what_was_read_before_a_spin_may_be_old_after_it(main: str, callback: str) -> None:
    assert races(main, callback) == ['CC301']


def test_what_was_tested_before_a_spin_may_be_gone_after_it() -> None:
    main = 'if node.asked is not None:\n    serve(node)\n    print(node.asked.data)'
    assert races(main, CLEAR) == ['CC305']


def test_callbacks_that_a_thread_runs_come_in_anywhere() -> None:
    thread = 'threading.Thread(target=serve, args=(brake,), daemon=True).start()\n'
    assert 'CC301' in races('serve(node)\nnode.level += 1', COUNT, by_thread=thread)


POOL = """\
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool, Int32

class Brake(Node):
    def __init__(self):
        super().__init__('brake')
        self.create_subscription(Int32, 'level', self.on_level, 1)
        self.watcher = Node('watcher')
        self.others = MultiThreadedExecutor(2)
        self.others.add_node(self.watcher)
        threading.Thread(target=self.others.spin, daemon=True).start()
        self.level = 0

    def on_level(self, msg):
        self.level += self.step()

    def step(self):
        return 1

def main():
    rclpy.init()
    executor, brake = MultiThreadedExecutor(4), Brake()
    {}

if __name__ == '__main__':
    main()
"""
EVER = 'executor.add_node(brake)\n    executor.spin()'
STEP = 'executor.add_node(brake)\n    executor.spin_once()\n    brake.level = 3'


@pytest.mark.parametrize(('spins', 'codes'), [(EVER, []), (STEP, ['CC301'])])
def test_a_pool_that_main_spins_for_ever_runs_nothing_before(spins: str, codes: list[str]) -> None:
    units = scan_text(POOL.format(spins)).units
    found = findings_of(units, [], [None] * len(units))
    assert sorted({each.code for each in found if each.code.startswith('CC3')}) == codes
