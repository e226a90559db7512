"""EffectLog: what a callback hands to the loop of asyncio is not done by the callback."""

import asyncio
import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Bridge(Node):
    def __init__(self, loop):
        super().__init__('bridge')
        self.loop = loop
        self.sent = 0
        self.seen = 0
        self.create_subscription(String, 'text', self.on_text, 10)

    def on_text(self, msg):
        self.seen = 1
        if self.loop.is_running():
            asyncio.run_coroutine_threadsafe(self.send(msg.data), self.loop)
        else:
            self.loop.create_task(self.send(msg.data))

    async def send(self, text):
        await asyncio.sleep(0.1)
        self.sent += 1


def main():
    rclpy.init()
    loop = asyncio.new_event_loop()
    threading.Thread(target=loop.run_forever, daemon=True).start()
    rclpy.spin(Bridge(loop))

# expect:
# unit bridge: SingleThreadedExecutor x1 rclpy.spin, main
#   group bridge_default EXCLUSIVE default
#   subscription on_text in bridge_default key=text
#     reads Bridge.loop @21
#     reads Bridge.loop @22
#     reads Bridge.loop rests later @24
#     writes Bridge.seen @20
#   activity thread run_forever daemon loops
#   activity thread send (Bridge.send) started by on_text conditional @22 conditional count=?
#     blocks asyncio.sleep 0.1 s @27
#     writes Bridge.sent update @28
