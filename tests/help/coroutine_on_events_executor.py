"""A service is a coroutine, and the events executor of older releases does not run it."""

import rclpy
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.create_service(Trigger, 'open', self.on_open)
        self.client = self.create_client(Trigger, 'open')
        self.create_timer(0.3, self.ask)

    def ask(self):
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)

    def on_answer(self, future):
        print('goes on')

    async def on_open(self, request, response):
        return response


def main():
    rclpy.init()
    executor = EventsExecutor()
    executor.add_node(Gate())
    executor.spin()


if __name__ == '__main__':
    main()
