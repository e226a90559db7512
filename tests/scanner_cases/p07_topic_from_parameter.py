"""P7: a name from a parameter is not known; the entity is."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.declare_parameter('topic', 'in')
        topic = self.get_parameter('topic').value
        self.create_subscription(String, topic, self.on_in, 10)

    def on_in(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_in in a_default key=in ASSUMED
