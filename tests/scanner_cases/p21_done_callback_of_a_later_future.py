"""P21: an answer kept in an attribute that is None until another callback has run."""
# live: no, an answer needs the action server

import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from std_msgs.msg import Empty
from tf2_msgs.action import LookupTransform


class Turner(Node):
    def __init__(self):
        super().__init__('turner')
        self.action = ActionClient(self, LookupTransform, 'spin')
        self.handle = None
        self.gone = None
        self.create_subscription(Empty, 'turn', self.on_turn, 10)
        self.create_subscription(Empty, 'stop', self.on_stop, 10)

    def on_turn(self, msg):
        if self.gone:
            self.gone.add_done_callback(self.turn)
        else:
            self.turn(None)

    def turn(self, future):
        self.action.send_goal_async(LookupTransform.Goal()).add_done_callback(self.accepted)

    def accepted(self, future):
        self.handle = future.result()
        self.handle.get_result_async().add_done_callback(self.ended)

    def on_stop(self, msg):
        if self.handle is not None:
            self.gone = self.handle.cancel_goal_async()
            self.gone.add_done_callback(self.stopped)

    def stopped(self, future):
        self.handle = None

    def ended(self, future):
        self.handle = None


def main():
    rclpy.init()
    rclpy.spin(Turner())


if __name__ == '__main__':
    main()

# expect:
# unit turner: SingleThreadedExecutor x1 rclpy.spin, main
#   group turner_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   subscription on_turn in turner_default key=turn
#     reads Turner.gone @21
#     reads Turner.gone rests @22
#     changes done_callback @22
#     changes done_callback @24>27
#   subscription on_stop in turner_default key=stop
#     reads Turner.handle @34
#     reads Turner.handle rests @35
#     reads Turner.gone @36
#     writes Turner.gone @35
#     changes done_callback @36
#   action_client spin_action_client in turner_default key=spin
#   done_callback accepted in no_group key=spin conditional when=callback
#     reads Turner.handle @31
#     writes Turner.handle @30
#     changes done_callback @31
#   done_callback ended in no_group key=spin conditional when=callback
#     writes Turner.handle clears @42
#   done_callback stopped in no_group key=spin conditional when=callback
#     writes Turner.handle clears @39
#   done_callback turn in no_group key=spin conditional when=callback
#     changes done_callback @27
