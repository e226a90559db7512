"""A thread of the camera driver completes the future that a callback awaits; nothing else runs."""

import threading
import time

import rclpy
from rclpy.node import Node
from rclpy.task import Future


class Camera(Node):
    def __init__(self):
        super().__init__('camera', start_parameter_services=False)
        self.picture = Future()
        self.trigger = self.create_timer(0.1, self.take_picture)

    async def take_picture(self):
        self.trigger.cancel()
        threading.Thread(target=self.expose, daemon=True).start()
        print('exposing', flush=True)
        # differs: future-wakes
        await self.picture
        print('picture', flush=True)

    def expose(self):
        time.sleep(0.5)
        self.picture.set_result('pixels')


def main():
    rclpy.init()
    rclpy.spin(Camera())


if __name__ == '__main__':
    main()
