"""The own executor is spun for a future; the client is in another group."""

import rclpy
from answering import answer_elsewhere
from rclpy import executors
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class Caller(Node):
    def __init__(self):
        super().__init__('caller')
        self.client = self.create_client(
            Trigger, 'answer', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.client.wait_for_service()
        self.timer = self.create_timer(0.1, self.ask)
        self.create_timer(0.05, self.tick, callback_group=MutuallyExclusiveCallbackGroup())

    def ask(self):
        self.timer.cancel()
        print('asks', flush=True)
        future = self.client.call_async(Trigger.Request())
        self.executor.spin_until_future_complete(future, timeout_sec=0.5)
        print('answered' if future.done() else 'no answer', flush=True)
        print('goes on', flush=True)

    def tick(self):
        print('other group', flush=True)


def main():
    rclpy.init()
    answer_elsewhere()
    node = Caller()
    executor = executors.MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# single: ok, node kept
# multi: ok, node kept
# single with spin-refused-twice: raises, node lost
# multi with spin-refused-twice: raises, node lost
