"""
The process of ``why.py``: a healthy node, busy on a pool, and a thread that ticks beside it.

Argument: the file that the gaps between its ticks go into. The ticking thread needs the lock of
the interpreter for each tick, as every callback does. Needs rclpy only.
"""

import struct
import sys
import threading
import time
from pathlib import Path

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int64
from std_srvs.srv import Trigger

TICK_S = 0.001
# A gap that is shorter is a tick like all others.
TOLD_FROM_S = 0.002
GAP = struct.Struct('ddd')
NODES = 3


class Station(Node):
    """Publishes, hears, calls and answers."""

    def __init__(self, number: int) -> None:
        super().__init__(f'station_{number}')
        free = ReentrantCallbackGroup()
        self.publisher = self.create_publisher(Int64, 'clock_ns', 10)
        # In groups that close, an executor with a pool polls, and keeps a core busy.
        self.create_subscription(Int64, 'clock_ns', self.on_message, 10, callback_group=free)
        self.client = self.create_client(Trigger, f'ask_{number}', callback_group=free)
        self.create_service(Trigger, f'ask_{number}', self.on_ask, callback_group=free)
        self.create_timer(0.02, self.on_timer, callback_group=free)
        self.create_timer(0.1, self.on_call, callback_group=free)

    def on_timer(self) -> None:
        self.publisher.publish(Int64(data=time.monotonic_ns()))

    def on_message(self, message: Int64) -> None:
        sum(range(1000))

    def on_ask(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        return response

    def on_call(self) -> None:
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request())


def tick(path: Path) -> None:
    """Write when a tick was late, by how much, and what the process has computed meanwhile."""
    with path.open('ab', buffering=0) as stream:
        last, used = time.monotonic(), time.process_time()
        while True:
            time.sleep(TICK_S)
            now, used_now = time.monotonic(), time.process_time()
            if now - last > TOLD_FROM_S:
                stream.write(GAP.pack(now, now - last, used_now - used))
            last, used = now, used_now


def main() -> None:
    rclpy.init()
    executor = MultiThreadedExecutor(4)
    for number in range(NODES):
        executor.add_node(Station(number))
    threading.Thread(target=tick, args=(Path(sys.argv[1]),), daemon=True).start()
    executor.spin()


if __name__ == '__main__':
    main()
