"""P21: a done-callback is in no group."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.client = self.create_client(Trigger, 'go')
        self.create_timer(1.0, self.ask)

    def ask(self):
        future = self.client.call_async(Trigger.Request())
        future.add_done_callback(self.on_answer)

    def on_answer(self, future):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   timer ask in a_default every 1
#     changes done_callback @16
#   client go_client in a_default key=go
#   done_callback on_answer in no_group key=go conditional when=callback
