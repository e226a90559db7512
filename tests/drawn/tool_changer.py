"""Tool changer: a change asks the magazine and the spindle, one after the other."""
import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger


class Machine(Node):

    def __init__(self):
        super().__init__('machine')
        self.create_service(Trigger, 'magazine/next', self._on_next)
        self.create_service(SetBool, 'spindle/clamp', self._on_clamp)

    def _on_next(self, request, response):
        time.sleep(0.05)
        response.success, response.message = True, 'T7'
        return response

    def _on_clamp(self, request, response):
        time.sleep(0.05)
        response.success = True
        return response


class ServiceProxy:
    """Synchronous face of a client."""

    def __init__(self, node, srv_type, name):
        self._group = MutuallyExclusiveCallbackGroup()
        self._client = node.create_client(srv_type, name, callback_group=self._group)

    def __call__(self, request, timeout=2.0):
        arrived = threading.Event()
        future = self._client.call_async(request)
        future.add_done_callback(lambda _: arrived.set())
        if not arrived.wait(timeout):
            self._client.remove_pending_request(future)
            raise TimeoutError(self._client.srv_name)
        return future.result()


class ToolChanger(Node):

    def __init__(self):
        super().__init__('tool_changer')
        self._magazine = ServiceProxy(self, Trigger, 'magazine/next')
        self._spindle = ServiceProxy(self, SetBool, 'spindle/clamp')
        self._tool = 'none'
        self._pub = self.create_publisher(String, 'tool', 10)
        self.create_service(Trigger, 'change_tool', self._on_change)

    def _on_change(self, request, response):
        try:
            self._spindle(SetBool.Request(data=False))
            self._tool = self._magazine(Trigger.Request()).message
            self._spindle(SetBool.Request(data=True))
        except TimeoutError as err:
            response.success, response.message = False, f'{err} does not answer'
            return response
        self._pub.publish(String(data=self._tool))
        response.success, response.message = True, self._tool
        return response


class Program(Node):

    def __init__(self):
        super().__init__('program')
        self._change = self.create_client(Trigger, 'change_tool')
        self._pending = None
        self.create_timer(0.5, self._step)

    def _step(self):
        if self._pending is not None:
            if not self._pending.done():
                return
            self.get_logger().info(f'change: {self._pending.result().message}')
        self._pending = None
        if self._change.service_is_ready():
            self._pending = self._change.call_async(Trigger.Request())


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    for node in (Machine(), ToolChanger(), Program()):
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown(timeout_sec=3.0)
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
