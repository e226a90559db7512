"""P11: entities made on a local node variable."""

import rclpy
from std_msgs.msg import String


def on_in(msg):
    pass


def tick():
    pass


def main():
    rclpy.init()
    node = rclpy.create_node('a')
    node.create_subscription(String, 'in', on_in, 10)
    node.create_timer(0.5, tick)
    rclpy.spin(node)


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   subscription on_in in a_default key=in
