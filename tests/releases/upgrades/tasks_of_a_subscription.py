"""A message starts two steps, coroutines, in the order in which they are listed."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty


class Assembler(Node):
    def __init__(self):
        super().__init__('assembler')
        self.publisher = self.create_publisher(Empty, 'begin', 10)
        self.create_subscription(Empty, 'begin', self.on_begin, 10)
        self.once = self.create_timer(0.3, self.begin)

    def begin(self):
        if self.publisher.get_subscription_count():
            self.once.cancel()
            self.publisher.publish(Empty())

    def on_begin(self, message):
        self.executor.create_task(self.pick())
        # differs: tasks-oldest-first
        self.executor.create_task(self.place())

    async def pick(self):
        print('pick', flush=True)

    async def place(self):
        print('place', flush=True)


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Assembler())
    executor.spin()


if __name__ == '__main__':
    main()
