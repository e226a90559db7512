"""P43, P56, Point 20: inputs of a filter that a life-cycle node makes and destroys again."""
# live: no, no message_filters among the wheels

import rclpy
from message_filters import Subscriber, TimeSynchronizer
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_msgs.msg import String


class A(LifecycleNode):
    def __init__(self):
        super().__init__('a')

    def on_activate(self, state):
        self.left = Subscriber(self, String, 'l')
        self.right = Subscriber(self, String, 'r')
        self.pairs = TimeSynchronizer([self.left, self.right], 5)
        self.pairs.registerCallback(self.two)
        return TransitionCallbackReturn.SUCCESS

    def on_deactivate(self, state):
        self.destroy_subscription(self.left.sub)
        return TransitionCallbackReturn.SUCCESS

    def two(self, left, right):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription l_two in a_default (A.two) key=l destroyed when=configure library=message_filters
#   subscription r_two in a_default (A.two) key=r when=configure library=message_filters
#   lifecycle_service on_activate in a_default
#     reads A.left @17
#     reads A.right @17
#     reads A.pairs @18
#     writes A.left @15
#     writes A.right @16
#     writes A.pairs @17
#     changes subscription @15
#     changes subscription @16
#   lifecycle_service on_deactivate in a_default
#     reads A.left @22
