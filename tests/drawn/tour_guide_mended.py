import time

import rclpy
from action_msgs.msg import GoalStatus
from rclpy.action import ActionServer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci

from h02_helper_navigator import Navigator


class BaseDriver(Node):
    """Drives along the waypoints of a goal."""

    def __init__(self):
        super().__init__('base_driver')
        self._server = ActionServer(
            self, Fibonacci, 'follow', self.execute,
            callback_group=ReentrantCallbackGroup())

    def execute(self, goal_handle):
        feedback = Fibonacci.Feedback()
        for index in range(goal_handle.request.order):
            time.sleep(0.3)
            feedback.sequence.append(index)
            goal_handle.publish_feedback(feedback)
        goal_handle.succeed()
        result = Fibonacci.Result()
        result.sequence = feedback.sequence
        self.get_logger().info('path driven')
        return result


class TourGuide(Node):

    def __init__(self):
        super().__init__('tour_guide')
        self.declare_parameter('stops', 4)
        self._tours = 0
        self._navigator = Navigator(self, 'follow', ReentrantCallbackGroup())
        self._service = self.create_service(Trigger, 'start_tour', self.start_tour)

    def start_tour(self, request, response):
        self.get_logger().info('tour starting')
        status = self._navigator.go(self.get_parameter('stops').value)
        self._tours += 1
        response.success = status == GoalStatus.STATUS_SUCCEEDED
        response.message = 'tour %d status %d' % (self._tours, status)
        return response


class FrontDesk(Node):

    def __init__(self):
        super().__init__('front_desk')
        self._client = self.create_client(Trigger, 'start_tour')
        self._timer = self.create_timer(0.5, self.ask)

    def ask(self):
        if self._client.service_is_ready():
            self._timer.cancel()
            future = self._client.call_async(Trigger.Request())
            future.add_done_callback(self.report)

    def report(self, future):
        self.get_logger().info('desk heard: ' + future.result().message)


def main():
    rclpy.init()
    nodes = [BaseDriver(), TourGuide(), FrontDesk()]
    executor = MultiThreadedExecutor(num_threads=6)
    for node in nodes:
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        for node in nodes:
            node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
