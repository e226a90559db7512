"""P33: two hidden subscriptions in a reentrant group of their own."""
# live: no, no tf2 among the wheels

import rclpy
from rclpy.node import Node
from tf2_ros import Buffer, TransformListener


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group tf REENTRANT library=tf2_ros.TransformListener
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   subscription tf_callback in tf key=/tf library=tf2_ros.TransformListener
#   subscription tf_static_callback in tf key=/tf_static library=tf2_ros.TransformListener
