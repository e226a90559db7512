"""P21: the answer of one client of several, under a key that is only known at run time."""
# live: no, an answer needs the services

import rclpy
from action_msgs.srv import CancelGoal
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger
from tf2_msgs.action import LookupTransform


class A(Node):
    def __init__(self, found):
        super().__init__('arms')
        self.sides = {
            'left': self.create_client(Trigger, 'l'),
            'right': self.create_client(Trigger, 'r'),
        }
        self.cancels = [self.create_client(CancelGoal, 'cancel')]
        self.handed_in = found['client']
        self.action = found['action']
        self.create_subscription(String, 'stop', self.on_stop, 10)

    def on_stop(self, msg):
        self.sides[msg.data].call_async(Trigger.Request()).add_done_callback(self.off)
        first = self.cancels[len(msg.data)]
        first.call_async(CancelGoal.Request()).add_done_callback(self.cancelled)
        future = self.handed_in.call_async(Trigger.Request())
        future.add_done_callback(self.told)
        goal = LookupTransform.Goal()
        self.action.send_goal_async(goal, feedback_callback=self.heard).add_done_callback(
            self.accepted
        )

    def off(self, future):
        pass

    def cancelled(self, future):
        pass

    def told(self, future):
        pass

    def heard(self, feedback):
        pass

    def accepted(self, future):
        future.result().get_result_async().add_done_callback(self.ended)

    def ended(self, future):
        pass


def main():
    rclpy.init()
    rclpy.spin(A(__import__('found').CLIENTS))


if __name__ == '__main__':
    main()

# expect:
# unit arms: SingleThreadedExecutor x1 rclpy.spin, main
#   group arms_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   subscription on_stop in arms_default key=stop
#     reads A.sides @25
#     reads A.cancels @26
#     reads A.handed_in @28
#     reads A.action @31
#     changes done_callback @25
#     changes done_callback @27
#     changes done_callback @29
#     changes done_callback @31
#   client l_client in arms_default key=l
#   client r_client in arms_default key=r
#   client cancel_client in arms_default key=cancel
#   done_callback l_off in no_group (A.off) key=l conditional when=callback
#   done_callback r_off in no_group (A.off) key=r conditional when=callback
#   done_callback cancelled in no_group key=cancel conditional when=callback
#   done_callback told in no_group conditional when=callback
#   done_callback accepted in no_group conditional when=callback
#     changes done_callback @48
#   done_callback ended in no_group conditional when=callback
#   ? arms entities
