"""The set-up puts a new future into an attribute each time it has waited for the last one."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

STEPS = """\
import rclpy
from message_filters import ApproximateTimeSynchronizer, Subscriber
from rclpy.node import Node
from rclpy.task import Future
from sensor_msgs.msg import Imu, LaserScan

class Probe(Node):
    def __init__(self):
        super().__init__('probe')
        inputs = [Subscriber(self, LaserScan, 'scan'), Subscriber(self, Imu, 'imu')]
        self.joined = ApproximateTimeSynchronizer(inputs, 10, 0.1)
        self.joined.registerCallback(self.on_both)
        self.create_timer(0.1, self.tick)
        self.sample = Future()
        self.period = Future()

    def on_both(self, scan, imu):
        SETS

    def tick(self):
        self.period.set_result(None)

    def step(self):
        while not self.period.done():
            rclpy.spin_once(self)
        self.period = Future()
        rclpy.spin_until_future_complete(self, self.sample)
        sample, self.sample = self.sample, Future()
        return sample.result()

def main():
    rclpy.init()
    probe = Probe()
    ROUNDS
        probe.step()

if __name__ == '__main__':
    main()
"""
NEVER = (
    'rclpy.spin_until_future_complete waits for sample, but nothing ends that wait: '
    'it waits forever'
)


@pytest.mark.parametrize('rounds', ['for _ in range(3):', 'while rclpy.ok():'])
def test_callbacks_end_what_was_there_when_the_set_up_waited(rounds: str) -> None:
    found = scan_text(
        STEPS.replace('SETS', 'self.sample.set_result(scan)').replace('ROUNDS', rounds)
    )
    assert found.diagnostics == ()
    set_up = [wait for unit in found.units for wait in unit.set_up]
    waits = {wait.call: {waker.by for waker in wait.wakers} for wait in set_up}
    assert set(waits) == {'busy wait', 'spin_until_future_complete'}
    assert 'tick' in waits['busy wait']
    assert all(waits.values())


def test_a_future_that_no_callback_completes_is_told() -> None:
    found = scan_text(STEPS.replace('SETS', 'pass').replace('ROUNDS', 'for _ in range(3):'))
    assert [each.message for each in found.diagnostics] == [NEVER]


MANY = """\
import threading
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'home')

    def ask(self):
        done = threading.Event()

        def on_answer(future):
            SETS

        self.client.call_async(Trigger.Request()).add_done_callback(on_answer)
        done.wait()

    def work(self, finished):
        for _ in range(5):
            self.ask()
            self.ask()
        finished.set()

rclpy.init()
node = Asker()
finished = threading.Event()
threading.Thread(target=node.work, args=(finished,), daemon=True).start()
while not finished.is_set():
    rclpy.spin_once(node, timeout_sec=0.1)
"""


@pytest.mark.parametrize(('sets', 'told'), [('done.set()', []), ('pass', ['nobody-spins'])])
def test_the_tenth_answer_ends_its_wait_like_the_first(sets: str, told: list[str]) -> None:
    found = scan_text(MANY.replace('SETS', sets))
    assert [each.slug for each in found.diagnostics] == told
