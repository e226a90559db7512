"""An event that the result of a goal sets: two done-callbacks, the one asked for by the other."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import rclpy
from rclpy.action import ActionClient
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci

class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.event = threading.Event()
        self.client = ActionClient(
            self, Fibonacci, 'load', callback_group=ReentrantCallbackGroup()
        )
        TIMED

    def ask(self):
        FIRST
        self.client.send_goal_async(Fibonacci.Goal()).add_done_callback(self.on_goal)
        BEHIND
        self.event.wait()

    def on_goal(self, future):
        future.result().get_result_async().add_done_callback(self.on_result)

    def on_result(self, future):
        self.event.set()

def main():
    rclpy.init()
    asker = Asker()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(asker)
    MAIN

main()
"""
CLEARS = 'self.event.clear()'
BY_TIMER = ('self.create_timer(1.0, self.ask)', 'executor.spin()')
BY_MAIN = ('pass', 'threading.Thread(target=executor.spin, daemon=True).start(); asker.ask()')
TOLD = 'on_result, which ends it, runs once only, and perhaps before it is cleared'


@pytest.mark.parametrize(('timed', 'main'), [BY_TIMER, BY_MAIN])
@pytest.mark.parametrize(
    ('first', 'behind', 'told'), [(CLEARS, 'pass', None), ('pass', CLEARS, TOLD)]
)
def test_the_result_may_be_there_before_the_clear(
    timed: str, main: str, first: str, behind: str, told: str | None
) -> None:
    text = PROGRAM.replace('TIMED', timed).replace('MAIN', main)
    (unit,) = scan_text(text.replace('FIRST', first).replace('BEHIND', behind)).units
    found = {
        wait.escapes.reason if wait.escapes is not None else None
        for doer in (*unit.callbacks, *unit.activities)
        for wait in doer.blocking
        if wait.call == 'Event.wait'
    }
    assert found == {told}
