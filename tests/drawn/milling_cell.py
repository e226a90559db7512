import threading
import time

import rclpy
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import (
    ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor)
from rclpy.node import Node
from test_msgs.action import Fibonacci


class MillingCell(Node):
    """Mills one part at a time and turns further jobs away."""

    CAPACITY = 1

    def __init__(self):
        super().__init__('milling_cell')
        self.declare_parameter('pass_time', 0.3)
        self._lock = threading.Lock()
        self._running = 0
        self._server = ActionServer(
            self, Fibonacci, 'mill',
            execute_callback=self.execute,
            goal_callback=self.on_goal,
            cancel_callback=lambda handle: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup())

    def on_goal(self, goal):
        with self._lock:
            if self._running >= self.CAPACITY:
                return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def execute(self, goal_handle):
        pass_time = self.get_parameter('pass_time').value
        self._home_spindle()
        with self._lock:
            self._running += 1
            running = self._running
        self.get_logger().info('spindle on, %d part(s) in the cell' % running)
        feedback = Fibonacci.Feedback()
        try:
            for index in range(goal_handle.request.order):
                time.sleep(pass_time)
                feedback.sequence.append(index)
                goal_handle.publish_feedback(feedback)
            goal_handle.succeed()
        finally:
            with self._lock:
                self._running -= 1
        return Fibonacci.Result(sequence=feedback.sequence)

    def _home_spindle(self):
        time.sleep(0.2)


class JobShop(Node):
    """Has two desks that send parts; a part turned away is sent again."""

    def __init__(self):
        super().__init__('job_shop')
        self._desks = {
            desk: ActionClient(self, Fibonacci, 'mill') for desk in ('A', 'B')}
        self._waiting = ['A', 'B']
        self.create_timer(0.8, self.send)

    def send(self):
        if not all(c.server_is_ready() for c in self._desks.values()):
            return
        desks, self._waiting = self._waiting, []
        for desk in desks:
            sent = self._desks[desk].send_goal_async(Fibonacci.Goal(order=3))
            sent.add_done_callback(lambda future, desk=desk: self.on_reply(desk, future))

    def on_reply(self, desk, future):
        handle = future.result()
        if not handle.accepted:
            self.get_logger().info('desk %s turned away' % desk)
            self._waiting.append(desk)
            return
        handle.get_result_async().add_done_callback(
            lambda done: self.on_result(desk, done))

    def on_result(self, desk, future):
        self.get_logger().info('desk %s part done' % desk)
        self._waiting.append(desk)


def main():
    rclpy.init()
    cell = MillingCell()
    shop = JobShop()
    machines = MultiThreadedExecutor(num_threads=4)
    machines.add_node(cell)
    office = SingleThreadedExecutor()
    office.add_node(shop)
    thread = threading.Thread(target=machines.spin, daemon=True)
    thread.start()
    try:
        office.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        machines.shutdown(timeout_sec=1.0)
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
