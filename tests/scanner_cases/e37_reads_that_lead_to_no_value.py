"""EffectLog: what a function reads for a log line or for another attribute does not decide its result."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.told = ''
        self.pose = None
        self.state = 'idle'
        self.seen = []
        self.create_subscription(String, 'go', self.on_go, 10)
        self.create_subscription(String, 'pose', self.on_pose, 10)

    def find(self):
        self.get_logger().info(self.told)
        self.told = 'asked in ' + self.state
        return self.pose

    def rows(self):
        found = []
        found.append(self.seen)
        return found

    def on_go(self, msg):
        if self.find() is None:
            self.told = 'nowhere'
            self.state = 'lost'
            self.pose = msg
        self.seen = self.rows()

    def on_pose(self, msg):
        self.pose, self.told, self.state = msg, 'there', 'here'


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_go in a_default key=go
#     reads A.told @29>19
#     reads A.state @29>20
#     reads A.pose @29>21
#     reads A.seen @33>25
#     writes A.told @29>20
#     writes A.told @30
#     writes A.state @31
#     writes A.pose rests @32
#     writes A.seen rests later @33
#   subscription on_pose in a_default key=pose
#     writes A.pose @36
#     writes A.told @36
#     writes A.state @36
