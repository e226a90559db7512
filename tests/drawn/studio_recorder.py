import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import (
    ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor)
from rclpy.node import Node
from std_msgs.msg import Empty
from test_msgs.srv import BasicTypes


class StudioRecorder(Node):
    """Records on request, one take per channel at a time."""

    CHANNELS = ('left', 'right')

    def __init__(self):
        super().__init__('studio_recorder')
        self.declare_parameter('chunk', 0.1)
        self._cut_time = 0.0
        for name in self.CHANNELS:
            self.create_service(
                BasicTypes, 'record/' + name, self.record,
                callback_group=MutuallyExclusiveCallbackGroup())
        self.create_subscription(
            Empty, 'cut', self.on_cut, 10,
            callback_group=MutuallyExclusiveCallbackGroup())

    def record(self, request, response):
        chunk = self.get_parameter('chunk').value
        start = time.monotonic()
        end = start + request.int32_value
        written = 0
        while rclpy.ok() and time.monotonic() < end and self._cut_time < start:
            time.sleep(chunk)
            written += 1
        response.int32_value = written
        return response

    def on_cut(self, msg):
        self.get_logger().info('cut')
        self._cut_time = time.monotonic()


class Director(Node):

    def __init__(self):
        super().__init__('director')
        self._cut = self.create_publisher(Empty, 'cut', 10)
        self._channels = [self.create_client(BasicTypes, 'record/' + name)
                         for name in StudioRecorder.CHANNELS]
        self._cut_at = None
        self._running = 0
        self._start = self.create_timer(0.5, self.action)
        self._watch = self.create_timer(1.0, self.shout)
        self._watch.cancel()

    def action(self):
        if not all(client.service_is_ready() for client in self._channels):
            return
        self._start.cancel()
        self._watch.reset()
        for client in self._channels:
            self._running += 1
            future = client.call_async(BasicTypes.Request(int32_value=6))
            future.add_done_callback(self.on_take)
        self.get_logger().info('action')

    def shout(self):
        self._watch.cancel()
        self._cut_at = time.monotonic()
        self._cut.publish(Empty())
        self.get_logger().info('asked to cut')

    def on_take(self, future):
        self._running -= 1
        late = time.monotonic() - self._cut_at
        self.get_logger().info('take over %.1f s after cut, %d chunks' % (
            late, future.result().int32_value))
        if self._running == 0:
            self._start.reset()


def main():
    rclpy.init()
    recorder = StudioRecorder()
    director = Director()
    studio = MultiThreadedExecutor(num_threads=2)
    studio.add_node(recorder)
    desk = SingleThreadedExecutor()
    desk.add_node(director)
    thread = threading.Thread(target=studio.spin, daemon=True)
    thread.start()
    try:
        desk.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        studio.shutdown(timeout_sec=1.0)
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
