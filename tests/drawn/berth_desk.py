"""Berth desk: gives the one berth to the ships, in the order in which they ask."""
import collections
import threading

import rclpy
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String


class BerthDesk(Node):

    def __init__(self):
        super().__init__('berth_desk')
        self._lock = threading.Lock()
        self._ship = ''
        self._waiting = collections.deque()
        self._given = 0
        self._pub = self.create_publisher(String, 'berth', 10)
        self.create_subscription(String, 'ask', self._on_ask, 10)
        self.create_subscription(String, 'leave', self._on_leave, 10)

    def _on_ask(self, msg):
        turn = Future()
        turn.add_done_callback(self._on_turn)
        with self._lock:
            self._waiting.append(turn)
            is_free = not self._ship
            self._ship = self._ship or msg.data
        if is_free:
            turn.set_result(msg.data)

    def _on_leave(self, msg):
        with self._lock:
            self._ship = ''
            if self._waiting:
                turn = self._waiting.popleft()
                turn.set_result(msg.data)

    def _on_turn(self, turn):
        with self._lock:
            self._given += 1
        self._pub.publish(String(data=turn.result()))


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(BerthDesk())
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
