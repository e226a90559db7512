"""A synchronous call from a thread that is none of the executor."""

import threading

import rclpy
from answering import answer_elsewhere
from rclpy import executors
from rclpy.node import Node
from std_srvs.srv import Trigger


class Caller(Node):
    def __init__(self):
        super().__init__('caller')
        self.client = self.create_client(Trigger, 'answer')
        self.client.wait_for_service()

    def ask(self):
        print('asks', flush=True)
        self.client.call(Trigger.Request())
        print('goes on', flush=True)


def main():
    rclpy.init()
    answer_elsewhere()
    node = Caller()
    executor = executors.MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    threading.Thread(target=node.ask, daemon=True).start()
    executor.spin()


if __name__ == '__main__':
    main()

# single: ok
# multi: ok
