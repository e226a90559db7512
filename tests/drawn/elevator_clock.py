import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import Float64
from std_srvs.srv import SetBool


class ElevatorNode(Node):
    """Drives the torso of the simulated robot: speed for a fixed (simulated) time, then stop."""

    TRAVEL_TIME = 1.0
    SPEED = 0.15

    def __init__(self):
        super().__init__('elevator', parameter_overrides=[Parameter('use_sim_time', value=True)])
        self._speed = 0.0
        self._raised = False
        self._output_group = MutuallyExclusiveCallbackGroup()
        self._speed_pub = self.create_publisher(Float64, 'torso/velocity', 10)
        self.create_service(SetBool, 'torso/raise', self.on_raise)
        self._wall_clock = rclpy.clock.Clock()
        self.create_timer(
            0.05, self.publish_speed, callback_group=self._output_group, clock=self._wall_clock)

    def on_raise(self, request, response):
        if request.data == self._raised:
            response.success = True
            response.message = 'already there'
            return response
        self._speed = self.SPEED if request.data else -self.SPEED
        self.get_logger().info('torso starts moving')
        self._wait(self.TRAVEL_TIME)
        self._speed = 0.0
        self._raised = request.data
        self.get_logger().info('torso stopped')
        response.success = True
        response.message = 'raised' if self._raised else 'lowered'
        return response

    def _wait(self, seconds):
        """Let simulated time pass."""
        clock = self.get_clock()
        until = clock.now() + Duration(seconds=seconds)
        while rclpy.ok() and clock.now() < until:
            time.sleep(0.01)

    def publish_speed(self):
        self._speed_pub.publish(Float64(data=self._speed))


def main():
    rclpy.init()
    node = ElevatorNode()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    try:
        executor.spin()
    except KeyboardInterrupt:
        pass


if __name__ == '__main__':
    main()
