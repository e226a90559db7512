"""P21: one helper adds the same function to the futures of several calls: one done-callback."""
# live: no, nothing calls the methods

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.cli = self.create_client(Trigger, 'other')

    def send(self, done):
        self.cli.call_async(Trigger.Request()).add_done_callback(done)

    def one(self):
        self.send(self.on_done)

    def two(self):
        self.send(self.on_done)

    def three(self):
        self.send(self.on_other)

    def on_done(self, future):
        pass

    def on_other(self, future):
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
#   client other_client in a_default key=other
#   done_callback on_done in no_group key=other conditional when=later
#   done_callback on_other in no_group key=other conditional when=later
