"""P33: looking a transform up with a timeout holds the thread; without one it does not."""
# live: no, tf2 is not among the wheels

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from std_srvs.srv import Trigger
from tf2_ros import Buffer, TransformListener


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.tf = Buffer()
        self.listener = TransformListener(self.tf, self)
        self.create_service(Trigger, 'where', self.where)

    def where(self, request, response):
        now = rclpy.time.Time()
        self.tf.lookup_transform('map', 'base', now)
        self.tf.lookup_transform('map', 'base', now, timeout=Duration(seconds=2.0))
        self.tf.lookup_transform('map', 'base', now, Duration())
        self.tf.can_transform('map', 'base', now, Duration(seconds=1, nanoseconds=500000000))
        self.tf.transform(request, 'map', self.patience())
        self.tf.transform(request, 'map', timeout=rclpy.duration.Duration(nanoseconds=1000))
        return response

    def patience(self):
        return self.get_parameter('patience').value


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group tf REENTRANT library=tf2_ros.TransformListener
#   group a_default EXCLUSIVE default
#   subscription tf_callback in tf key=/tf library=tf2_ros.TransformListener
#   subscription tf_static_callback in tf key=/tf_static library=tf2_ros.TransformListener
#   service where in a_default key=where
#     blocks Buffer.lookup_transform on tf_callback 2.0 s @21
#     blocks Buffer.can_transform on tf_callback 1.5 s @23
#     blocks Buffer.transform on tf_callback ? s @24
#     blocks Buffer.transform on tf_callback 1e-06 s @25
