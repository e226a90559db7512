"""P36: a method that the constructor calls on a branch not taken; nobody says when it spins."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.has_map = False
        self.create_timer(1.0, self.tick)
        if self.has_map:
            self.tags = self.ask()

    def tick(self):
        self.has_map = True

    def ask(self):
        client = self.create_client(Trigger, 'tags')
        future = client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)
        return future.result()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     writes A.has_map @18
#   client tags_client in a_default key=tags conditional when=later
