"""P20: an empty goal handle stands in an attribute until a goal was sent."""
# live: no, an empty handle cancels nothing

import rclpy
from rclpy.action import ActionClient
from rclpy.action.client import ClientGoalHandle
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Cook(Node):
    def __init__(self):
        super().__init__('cook')
        self.handle = ClientGoalHandle(None, None, None)
        self.client = ActionClient(self, Fibonacci, 'dish')
        self.create_timer(1.0, self.stop)

    def stop(self):
        self.handle.cancel_goal_async().add_done_callback(self.stopped)
        self.handle.get_result()

    def stopped(self, future):
        self.done = True


def main():
    rclpy.init()
    rclpy.spin(Cook())


if __name__ == '__main__':
    main()


# expect:
# unit cook: SingleThreadedExecutor x1 rclpy.spin, main
#   group cook_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   timer stop in cook_default every 1
#     blocks get_result on handle @20
#       ended by ?
#     changes done_callback @19
#   action_client dish_action_client in cook_default key=dish
#   done_callback stopped in no_group conditional when=callback
#     writes Cook.done @23
