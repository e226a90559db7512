"""B15: sends a request and waits for its done-callback, on the only thread."""

import threading

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.answered = threading.Event()
        self.client = self.create_client(Trigger, 'ask')
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.answered.clear()
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)
        self.answered.wait()

    def on_answer(self, future):
        self.answered.set()


def main():
    rclpy.init()
    rclpy.spin(Asker())


if __name__ == '__main__':
    main()

# finds: CC102:20
