# Action server for one manipulator: only one goal at a time may be accepted, further ones
# are rejected. Goals, cancels and execution may overlap (reentrant group, several threads).
import threading
import time
from contextlib import contextmanager

import rclpy
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class SingleGoalServer(Node):
    def __init__(self):
        super().__init__('manipulator')
        self._active = False
        self._running = 0
        self.peak = 0
        self._count_lock = threading.Lock()
        self._server = ActionServer(
            self, Fibonacci, 'manipulate', execute_callback=self._execute,
            goal_callback=self._on_goal, cancel_callback=lambda _: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup())

    def _reachable(self, request):
        """Stands for the inverse kinematics."""
        total = 0.0
        for step in range(2000):
            total += (step * request.order) % 7
        return total >= 0.0

    def _on_goal(self, request):
        if self._active:
            self.get_logger().info('busy, goal rejected')
            return GoalResponse.REJECT
        if not self._reachable(request):
            return GoalResponse.REJECT
        self._active = True
        return GoalResponse.ACCEPT

    @contextmanager
    def _counted(self):
        with self._count_lock:
            self._running += 1
            self.peak = max(self.peak, self._running)
        yield
        with self._count_lock:
            self._running -= 1

    def _execute(self, goal_handle):
        with self._counted():
            time.sleep(0.3)
        goal_handle.succeed()
        self._active = False
        return Fibonacci.Result(sequence=[goal_handle.request.order])


class Commander(Node):
    def __init__(self, name):
        super().__init__(name)
        self._client = ActionClient(self, Fibonacci, 'manipulate',
                                    callback_group=ReentrantCallbackGroup())

    def ready(self):
        return self._client.wait_for_server(timeout_sec=5.0)

    def send(self, order):
        self._client.send_goal_async(Fibonacci.Goal(order=order))


def main():
    rclpy.init()
    server = SingleGoalServer()
    commanders = [Commander(f'commander_{index}') for index in range(3)]
    executor = MultiThreadedExecutor(num_threads=8)
    for node in [server, *commanders]:
        executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    for commander in commanders:
        commander.ready()
    for number in range(10):
        for commander in commanders:
            commander.send(number)
        time.sleep(0.7)
    print('OBS goals executed at the same time, peak:', server.peak, flush=True)
    rclpy.shutdown()


if __name__ == '__main__':
    main()
