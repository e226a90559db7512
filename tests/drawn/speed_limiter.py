import threading

import rclpy
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import String

PROFILES = {
    'indoor': {'max_linear': 0.4, 'max_angular': 0.8},
    'outdoor': {'max_linear': 1.2, 'max_angular': 1.5},
    'creep': {'max_linear': 0.1, 'max_angular': 0.2},
}


class SpeedLimiter(Node):
    """Limits cmd_vel. The limits are parameters and can also be changed by a named profile."""

    def __init__(self):
        super().__init__('speed_limiter')
        self._lock = threading.Lock()
        self._limits = {}
        self._profile = 'indoor'
        for name, value in PROFILES[self._profile].items():
            self._limits[name] = self.declare_parameter(name, value).value
        self.add_on_set_parameters_callback(self.on_parameters)

        self._cmd_pub = self.create_publisher(Twist, 'cmd_vel', 10)
        self.create_subscription(Twist, 'cmd_vel_raw', self.on_twist, 10)
        self.create_subscription(String, 'speed_profile', self.on_profile, 1)

    def on_parameters(self, parameters):
        for parameter in parameters:
            if parameter.name in ('max_linear', 'max_angular') and parameter.value <= 0.0:
                return SetParametersResult(successful=False, reason=f'{parameter.name} <= 0')
        with self._lock:
            for parameter in parameters:
                if parameter.name in self._limits:
                    self._limits[parameter.name] = parameter.value
        return SetParametersResult(successful=True)

    def on_profile(self, msg):
        if msg.data not in PROFILES:
            self.get_logger().warning(f'no speed profile {msg.data!r}')
            return
        limits = [Parameter(name, value=value) for name, value in PROFILES[msg.data].items()]
        with self._lock:
            if msg.data == self._profile:
                return
            self._profile = msg.data
            self.set_parameters(limits)
        self.get_logger().info(f'speed profile {msg.data}')

    def on_twist(self, msg):
        with self._lock:
            linear = self._limits['max_linear']
            angular = self._limits['max_angular']
        out = Twist()
        out.linear.x = max(-linear, min(linear, msg.linear.x))
        out.angular.z = max(-angular, min(angular, msg.angular.z))
        self._cmd_pub.publish(out)


def main():
    rclpy.init()
    node = SpeedLimiter()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == '__main__':
    main()
