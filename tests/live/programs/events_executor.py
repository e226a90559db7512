"""The executor written in C++: a timer and a task."""

import sys

import rclpy

try:
    from rclpy.experimental import EventsExecutor
except ImportError:
    sys.exit(print('no EventsExecutor'))

rclpy.init()
node = rclpy.create_node('eventful')
ticks: list[int] = []
work_done: list[int] = []


def tick() -> None:
    ticks.append(1)
    assert timer.callback is tick


def work() -> None:
    work_done.append(1)


timer = node.create_timer(0.01, tick)
executor = EventsExecutor()
executor.add_node(node)
executor.create_task(work)
while len(ticks) < 3:
    executor.spin_once(timeout_sec=1)
print('ticks', len(ticks))
executor.remove_node(node)
rclpy.shutdown()
