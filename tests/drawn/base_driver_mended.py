"""Velocity interface of a small mobile base with two operating modes."""
import rclpy
from geometry_msgs.msg import Twist
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool

from helper_14_gate import BaseMode, ModeGate, WheelBase


class BaseDriver(Node):
    """Accepts velocity commands only while in navigation mode."""

    def __init__(self) -> None:
        super().__init__('base_driver')
        self._base = WheelBase()
        self._gate = ModeGate()
        self._max_v = self.declare_parameter('max_linear', 0.4).value
        self._rejected = 0

        motion = MutuallyExclusiveCallbackGroup()
        admin = MutuallyExclusiveCallbackGroup()
        self._speed_pub = self.create_publisher(Float64, 'speed', 10)
        self._mode_pub = self.create_publisher(String, 'mode', 10)
        self.create_subscription(Twist, 'cmd_vel', self._on_cmd, 10, callback_group=motion)
        self.create_service(
            SetBool, 'navigation_mode', self._on_mode, callback_group=admin)
        self.create_timer(0.2, self._report, callback_group=MutuallyExclusiveCallbackGroup())

    def _on_cmd(self, msg: Twist) -> None:
        v = max(-self._max_v, min(self._max_v, msg.linear.x))
        w = msg.angular.z
        with self._gate:
            mode = self._gate.mode
            if mode is not BaseMode.NAVIGATION:
                self._rejected += 1
                self.get_logger().warning(f'command dropped in mode {mode.value}')
                return
            if v == 0.0 and w == 0.0:
                self._base.stop()
            else:
                self._base.drive(v, w)

    def _on_mode(self, request: SetBool.Request, response: SetBool.Response):
        wanted = BaseMode.NAVIGATION if request.data else BaseMode.POSITION
        self._switch(wanted)
        response.success = True
        response.message = wanted.value
        return response

    def _switch(self, wanted: BaseMode) -> None:
        with self._gate:
            self._base.stop()
            self._gate.mode = wanted
        self.get_logger().info(f'mode is now {wanted.value}')

    def _report(self) -> None:
        self._speed_pub.publish(Float64(data=self._base.v))
        self._mode_pub.publish(String(data=self._gate.mode.value))


def main() -> None:
    rclpy.init()
    node = BaseDriver()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
