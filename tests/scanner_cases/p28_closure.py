"""P28: nested functions as callbacks."""

import rclpy
from std_msgs.msg import String


def main():
    rclpy.init()
    node = rclpy.create_node('a')
    seen = []

    def on_in(msg):
        seen.append(msg)

    node.create_subscription(String, 'in', on_in, 10)
    rclpy.spin(node)


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_in in a_default key=in
#     writes main.seen update in_place @13
