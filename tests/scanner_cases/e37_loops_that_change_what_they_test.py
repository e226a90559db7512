"""EffectLog: loops whose own rounds change what they test wait for nobody, whosever the object is."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Words:
    def __init__(self, text):
        self.left = text.split()

    def sum(self):
        total = [self.left.pop(0)]
        while len(self.left) > 0 and self.left[0] == '+':
            self.left.pop(0)
            total.append(self.left.pop(0))
        return total


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.rows = {}
        self.wanted = 3
        self.create_subscription(String, 'text', self.on_text, 10)
        self.create_subscription(String, 'row', self.on_row, 10)

    def on_text(self, msg):
        self.get_logger().info(str(Words(msg.data).sum()))

    def on_row(self, msg):
        self.rows[msg.data] = []
        while self.wanted >= len(self.rows[msg.data]):
            self.rows[msg.data].append({})


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_text in a_default key=text
#   subscription on_row in a_default key=row
#     reads A.rows @32
#     reads A.wanted @33
#     reads A.rows @33
#     reads A.rows @34
#     writes A.rows update in_place @32
