"""A9: a callback spins its own executor with the client in its group. Mended."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'answer')
        self.create_timer(0.1, self.tick)

    def tick(self):
        future = self.client.call_async(Trigger.Request())
        future.add_done_callback(self.on_answer)

    def on_answer(self, future):
        self.get_logger().info(future.result().message)


def main():
    rclpy.init()
    rclpy.spin(Asker())


if __name__ == '__main__':
    main()

# finds: nothing
