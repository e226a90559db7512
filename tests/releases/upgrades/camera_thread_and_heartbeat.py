"""The heartbeat keeps the executor turning, so that a future of a thread is seen at once."""

import threading
import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.task import Future


class Camera(Node):
    def __init__(self):
        super().__init__('camera')
        group = ReentrantCallbackGroup()
        self.picture = Future()
        self.trigger = self.create_timer(0.1, self.take_picture, callback_group=group)
        self.create_timer(0.1, self.beat, callback_group=group)

    def beat(self):
        self.beaten = True

    async def take_picture(self):
        self.trigger.cancel()
        threading.Thread(target=self.expose, daemon=True).start()
        print('exposing', flush=True)
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
