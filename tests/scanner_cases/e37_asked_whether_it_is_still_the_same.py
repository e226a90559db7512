"""EffectLog: who compares shared data with a name of its own asks whether others have stored there."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

IDLE = 'idle'


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.goal = None
        self.number = 0
        self.state = IDLE
        self.create_subscription(String, 'goal', self.on_goal, 10)

    def on_goal(self, msg):
        self.goal = msg
        self.number = number = len(msg.data)
        if self.goal is msg:
            self.goal = None
        if number != self.number:
            self.state = 'late'
        if self.state == IDLE or self.number == 5:
            self.state = 'busy'


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_goal in a_default key=goal
#     reads A.goal compared @21
#     reads A.number compared @23
#     reads A.state @25
#     reads A.number @25
#     writes A.goal @19
#     writes A.number @20
#     writes A.goal rests clears constant @22
#     writes A.state @24
#     writes A.state rests constant @26
