# Motor axis driver: commands arrive on cmd, a watchdog timer feeds the controller every
# 50 ms, a service changes the axis state and waits until the controller has done so.
import threading
import time
from enum import Enum

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float32
from std_srvs.srv import SetBool


class AxisState(Enum):
    IDLE = 1
    CLOSED_LOOP = 8


class Controller:
    """The motor controller: a state change takes it about a second."""

    def __init__(self):
        self._since = 0.0
        self._wanted = AxisState.IDLE
        self._fed = time.monotonic()
        self.longest_gap = 0.0

    def request(self, state):
        self._wanted = state
        self._since = time.monotonic()

    def state(self):
        return self._wanted if time.monotonic() - self._since > 1.0 else None

    def feed(self):
        now = time.monotonic()
        self.longest_gap = max(self.longest_gap, now - self._fed)
        self._fed = now


class AxisNode(Node):
    def __init__(self, controller):
        super().__init__('axis')
        self._controller = controller
        self._setpoint = 0.0
        self.create_subscription(Float32, 'cmd', self._on_cmd, 10)
        self.create_timer(0.05, self._feed_watchdog)
        self.create_service(SetBool, 'request_axis_state', self._on_request,
                            callback_group=MutuallyExclusiveCallbackGroup())

    def _on_cmd(self, msg):
        self._setpoint = msg.data

    def _feed_watchdog(self):
        self._controller.feed()

    def _on_request(self, request, response):
        wanted = AxisState.CLOSED_LOOP if request.data else AxisState.IDLE
        self._controller.request(wanted)
        response.success = self._await_state(wanted)
        response.message = wanted.name
        return response

    def _await_state(self, wanted, timeout=3.0):
        deadline = time.monotonic() + timeout
        while time.monotonic() < deadline:
            if self._controller.state() is wanted:
                return True
            time.sleep(0.1)
        return False


def main():
    rclpy.init()
    controller = Controller()
    node = AxisNode(controller)
    user = rclpy.create_node('user')
    client = user.create_client(SetBool, 'request_axis_state')
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    client.wait_for_service(timeout_sec=5.0)
    time.sleep(0.5)
    future = client.call_async(SetBool.Request(data=True))
    rclpy.spin_until_future_complete(user, future, timeout_sec=5.0)
    time.sleep(0.5)
    print('OBS answered', future.done(), 'longest watchdog gap %.2f s' % controller.longest_gap,
          flush=True)
    rclpy.shutdown()


if __name__ == '__main__':
    main()
