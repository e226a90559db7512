"""EffectLog: attributes of a helper object, written by one callback and read by another."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class State:
    def __init__(self):
        self.mode = 'idle'
        self.log = []

    def enter(self, mode):
        self.mode = mode
        self.log.append(mode)


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.state = State()
        self.create_subscription(String, 'in', self.on_in, 10)
        self.create_timer(1.0, self.tick)

    def on_in(self, msg):
        self.state.enter(msg.data)

    def tick(self):
        if self.state.mode == 'run':
            print(self.state.log)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     reads A.state @29
#     reads State.mode @29
#     reads A.state rests @30
#     reads State.log @30
#   subscription on_in in a_default key=in
#     reads A.state @26
#     writes State.mode @26>14
#     writes State.log update in_place @26>15
