"""EffectLog: transitions run in a service of rclpy; one that the program asks for runs in its caller."""

import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_srvs.srv import Trigger


class A(LifecycleNode):
    def __init__(self):
        super().__init__('a')
        self.client = self.create_client(Trigger, 'b')
        self.create_timer(9.0, self.tick)

    def on_configure(self, state):
        self.client.call(Trigger.Request())
        return TransitionCallbackReturn.SUCCESS

    def on_error(self, state):
        return TransitionCallbackReturn.SUCCESS

    def tick(self):
        self.trigger_configure()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 9
#     blocks client.call on b_client @22>15
#   client b_client in a_default key=b
#   lifecycle_service on_configure in a_default
#     blocks client.call on b_client @15
#   lifecycle_service on_error in a_default
