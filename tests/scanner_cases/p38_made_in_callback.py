"""P38: a timer made in a callback: conditional, unbounded."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_subscription(String, 'cmd', self.on_cmd, 10)

    def on_cmd(self, msg):
        if msg.data:
            self.t = self.create_timer(1.0, self.once)

    def once(self):
        self.t.cancel()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer once in a_default every 1 conditional one_shot count=? when=callback
#     reads A.t @18
#   subscription on_cmd in a_default key=cmd
#     writes A.t @15
#     changes timer @15
#   ? once count
