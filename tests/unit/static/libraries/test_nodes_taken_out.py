"""``rclpy.spin…`` of a node that a thread spins already, in code that others call."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
import window

class Panel:
    def __init__(self, node):
        self.node = node
        self.client = node.create_client(Trigger, 'start')
        {made}

    def clicked(self):
        future = self.client.call_async(Trigger.Request())
        {wait}

def main():
    rclpy.init()
    node = Node('panel')
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    panel = Panel(node)
    {rest}

main()
"""
SPIN = 'spinner = threading.Thread(target=executor.spin); spinner.start(); '
ASK = 'rclpy.spin_until_future_complete(self.node, future)'
BUTTON = 'window.loops.append((1, self.clicked))'


@pytest.mark.parametrize(
    ('made', 'wait', 'rest', 'lines'),
    [
        (BUTTON, ASK, SPIN + 'window.mainloop()', [17]),
        (BUTTON, ASK, SPIN + 'window.mainloop(); rclpy.shutdown(); spinner.join()', [17]),
        ('window.on_click(self.clicked)', ASK, SPIN + 'window.mainloop()', [17]),
        # It may be called before anything spins.
        ('pass', ASK, SPIN + 'window.mainloop()', []),
        (BUTTON, ASK, 'window.mainloop(); executor.spin()', []),
        # Or when the thread does no more.
        (BUTTON, ASK, SPIN + 'executor.shutdown(); window.mainloop()', []),
        (BUTTON, 'future.add_done_callback(print)', SPIN + 'window.mainloop()', []),
        ('pass', ASK, 'panel.clicked(); ' + SPIN, []),
    ],
)
def test_a_node_that_leaves_the_executor_of_a_thread(
    made: str, wait: str, rest: str, lines: list[int]
) -> None:
    found = scan_text(PROGRAM.format(made=made, wait=wait, rest=rest)).diagnostics
    mine = [each for each in found if each.slug == 'node-taken-out']
    assert [each.place.line for each in mine] == lines
    assert all('after that it is in none' in each.message for each in mine)


ROBBER = """
import threading
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Tour(Node):
    def __init__(self):
        super().__init__('tour')
        self.client = self.create_client(Trigger, 'open')
        self.create_timer(1.0, lambda: None)
        self.thread = threading.Thread(target=self.drive)
        self.thread.start()

    def drive(self):
        {spins}

def main():
    rclpy.init()
    tour = Tour()
    {first}
    executor = SingleThreadedExecutor()
    executor.add_node(tour)
    executor.spin()

main()
"""
SPINS = 'rclpy.spin_until_future_complete(self, self.client.call_async(Trigger.Request()))'

OWN = 'rclpy.spin_once(self, executor=SingleThreadedExecutor())'


@pytest.mark.parametrize(
    ('spins', 'first', 'lines'),
    [
        (SPINS, 'pass', [17]),
        (OWN, 'pass', [17]),
        (SPINS, 'tour.thread.join()', []),  # over before another executor has the node
        ('print(self)', 'pass', []),
        (SPINS, 'tour = rclpy.create_node("other")', []),
    ],
)
def test_a_node_that_a_thread_takes_out_which_began_before(
    spins: str, first: str, lines: list[int]
) -> None:
    found = scan_text(ROBBER.format(spins=spins, first=first)).diagnostics
    mine = [each for each in found if each.slug == 'node-taken-out']
    assert [each.place.line for each in mine] == lines


ENDED = """
import threading
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.client = self.create_client(Trigger, 'stop')
        self.create_timer(1.0, lambda: None)

    def destroy_node(self):
        future = self.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future, timeout_sec=1.0)
        super().destroy_node()

def main():
    rclpy.init()
    arm = Arm()
    executor = SingleThreadedExecutor()
    executor.add_node(arm)
    {rest}
    arm.destroy_node()

main()
"""
THREAD = 'spinner = threading.Thread(target=executor.spin); spinner.start(); input(); '


@pytest.mark.parametrize(
    ('rest', 'lines'),
    [
        ('executor.spin()', []),
        ('try:\n        executor.spin()\n    except KeyboardInterrupt:\n        pass', []),
        (THREAD + 'executor.shutdown(); spinner.join()', []),
        (THREAD, [16]),
        ('executor.spin_once(); arm.destroy_node(); executor.spin()', [16]),
    ],
)
def test_a_node_that_is_taken_out_when_its_spin_is_over(rest: str, lines: list[int]) -> None:
    found = scan_text(ENDED.format(rest=rest)).diagnostics
    mine = {each.place.line for each in found if each.slug == 'node-taken-out'}
    assert sorted(mine) == lines
