"""P42: a node stays in the executor it is in when that one spins until a future is done."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.cli = self.create_client(Trigger, 'other')


class B(Node):
    def __init__(self):
        super().__init__('b')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    a, b = A(), B()
    executor = SingleThreadedExecutor()
    executor.add_node(a)
    executor.add_node(b)
    future = a.cli.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(a, future, executor=executor, timeout_sec=1.0)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a_and_b: SingleThreadedExecutor x1 spin, main
#   nodes a, b
#   group a_default EXCLUSIVE default
#   group b_default EXCLUSIVE default
#   client other_client in a_default key=other node=a
#   timer tick in b_default every 0.5 node=b
