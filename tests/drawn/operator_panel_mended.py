"""Operator panel: an event loop in the main thread, ROS in the background."""
import heapq
import itertools
import queue
import threading
import time

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float32
from std_srvs.srv import SetBool


class EventLoop:
    """The few calls of a tool kit's root window which the panel needs."""

    def __init__(self):
        self._heap = []
        self._seq = itertools.count()
        self._alive = True

    def after(self, ms, callback):
        due = time.monotonic() + ms / 1000.0
        heapq.heappush(self._heap, (due, next(self._seq), callback))

    def quit(self):
        self._alive = False

    def mainloop(self):
        while self._alive and self._heap:
            due, _, callback = heapq.heappop(self._heap)
            time.sleep(max(0.0, due - time.monotonic()))
            callback()


class MotorDriver(Node):
    def __init__(self):
        super().__init__('motor_driver')
        self.enabled = False
        self.pub = self.create_publisher(Float32, 'motor/temperature', 10)
        self.create_service(SetBool, 'motor/enable', self.on_enable)
        self.create_timer(0.1, self.tick)

    def on_enable(self, request, response):
        self.enabled = request.data
        response.success = True
        return response

    def tick(self):
        self.pub.publish(Float32(data=41.5 if self.enabled else 22.0))


class PanelNode(Node):
    def __init__(self):
        super().__init__('operator_panel')
        self.inbox = queue.Queue()
        self.enable = self.create_client(SetBool, 'motor/enable')
        self.create_subscription(
            Float32, 'motor/temperature', self.inbox.put, 10)


class Panel:
    def __init__(self, root, node):
        self.root = root
        self.node = node
        self.updates = 0
        self.state = 'off'
        root.after(100, self.poll)
        root.after(1500, self.on_start_clicked)
        root.after(5000, self.root.quit)

    def poll(self):
        while not self.node.inbox.empty():
            self.node.inbox.get()
            self.updates += 1
        self.node.get_logger().info(
            'state %s, %d temperatures shown' % (self.state, self.updates),
            throttle_duration_sec=0.5)
        self.root.after(100, self.poll)

    def on_start_clicked(self):
        future = self.node.enable.call_async(SetBool.Request(data=True))
        self.state = 'starting'
        self.wait_for_start(future, time.monotonic() + 2.0)

    def wait_for_start(self, future, deadline):
        if future.done():
            self.state = 'on' if future.result().success else 'fault'
        elif time.monotonic() > deadline:
            self.state = 'fault'
        else:
            self.root.after(50, lambda: self.wait_for_start(future, deadline))


def spin(executor):
    try:
        executor.spin()
    except ExternalShutdownException:
        pass


def main():
    rclpy.init()
    node = PanelNode()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.add_node(MotorDriver())
    spinner = threading.Thread(target=spin, args=(executor,))
    spinner.start()
    root = EventLoop()
    Panel(root, node)
    root.mainloop()
    rclpy.shutdown()
    spinner.join()


if __name__ == '__main__':
    main()
