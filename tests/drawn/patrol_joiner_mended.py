import math
import threading

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_srvs.srv import Trigger


class PatrolNode(Node):
    """Drives an eight until it is told to stop."""

    PERIOD = 0.1

    def __init__(self):
        super().__init__('patrol')
        self._cmd_pub = self.create_publisher(Twist, 'cmd_vel', 10)
        self._stop = threading.Event()
        self._thread = None
        self.create_service(Trigger, 'patrol/start', self.on_start)
        self.create_service(Trigger, 'patrol/stop', self.on_stop)

    def on_start(self, request, response):
        if self._thread is not None:
            response.success = False
            response.message = 'patrol is running'
            return response
        self._stop.clear()
        self._thread = threading.Thread(target=self._patrol, daemon=True)
        self._thread.start()
        response.success = True
        return response

    def on_stop(self, request, response):
        if self._thread is None:
            response.success = False
            response.message = 'no patrol is running'
            return response
        self._stop.set()
        self._thread.join()
        self._thread = None
        self.get_logger().info('patrol stopped')
        response.success = True
        return response

    def _patrol(self):
        phase = 0.0
        while not self._stop.is_set():
            twist = Twist()
            twist.linear.x = 0.3
            twist.angular.z = 0.6 * math.copysign(1.0, math.sin(phase))
            self._cmd_pub.publish(twist)
            phase += 0.05
            self._stop.wait(self.PERIOD)
        self._cmd_pub.publish(Twist())


def main():
    rclpy.init()
    node = PatrolNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == '__main__':
    main()
