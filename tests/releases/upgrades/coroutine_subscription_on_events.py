"""A subscription that is a coroutine, on the EventsExecutor."""

import rclpy
from rclpy.experimental.events_executor import EventsExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Echo(Node):
    def __init__(self):
        super().__init__('echo')
        self.publisher = self.create_publisher(String, 'words', 10)
        self.create_subscription(String, 'words', self.on_word, 10)
        self.create_timer(0.3, self.say)

    def say(self):
        self.publisher.publish(String(data='hello'))

    # differs: coroutines-in-events
    async def on_word(self, message):
        print(message.data, flush=True)


def main():
    rclpy.init()
    # differs: events-executor
    executor = EventsExecutor()
    executor.add_node(Echo())
    while rclpy.ok():
        executor.spin_once(timeout_sec=1.0)


if __name__ == '__main__':
    main()
