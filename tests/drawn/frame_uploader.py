import asyncio
import threading

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import UInt8MultiArray


class Camera(Node):

    def __init__(self):
        super().__init__('camera')
        self.declare_parameter('size', 64)
        self._number = 0
        self._pub = self.create_publisher(UInt8MultiArray, 'frames', 10)
        self.create_timer(0.5, self.shoot)

    def shoot(self):
        self._number += 1
        size = self.get_parameter('size').value
        self._pub.publish(UInt8MultiArray(data=[self._number % 256] * size))
        if self._number % 4 == 0:
            self.get_logger().info('%d frames taken' % self._number)


class FrameUploader(Node):
    """Bridges frames to an asyncio upload client."""

    def __init__(self, loop):
        super().__init__('frame_uploader')
        self._loop = loop
        self._frames = asyncio.Queue()
        self.create_subscription(UInt8MultiArray, 'frames', self.on_frame, 10)

    def on_frame(self, msg):
        self._frames.put_nowait(msg)

    async def next_frame(self):
        return await self._frames.get()


class UploadSession:
    """Pretends to be the HTTP side."""

    def __init__(self, log):
        self._log = log
        self._bytes = 0

    async def upload(self, frame):
        await asyncio.sleep(0.05)
        self._bytes += len(frame.data)
        self._log.info('uploaded %d bytes' % self._bytes)


def spin(executor):
    try:
        executor.spin()
    except ExternalShutdownException:
        pass


async def run():
    loop = asyncio.get_running_loop()
    camera = Camera()
    uploader = FrameUploader(loop)
    executor = SingleThreadedExecutor()
    executor.add_node(camera)
    executor.add_node(uploader)
    thread = threading.Thread(target=spin, args=(executor,), daemon=True)
    thread.start()
    session = UploadSession(uploader.get_logger())
    try:
        while rclpy.ok():
            frame = await uploader.next_frame()
            await session.upload(frame)
    finally:
        executor.shutdown(timeout_sec=1.0)
        thread.join(timeout=2.0)


def main():
    rclpy.init()
    try:
        asyncio.run(run())
    except KeyboardInterrupt:
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
