import threading
import time

from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger


def wait_for(future):
    arrived = threading.Event()
    future.add_done_callback(lambda _: arrived.set())
    arrived.wait()
    return future.result()


class ShelfIndex(Node):

    def __init__(self):
        super().__init__('shelf_index')
        self._next = 0
        self.create_service(Trigger, 'shelf/locate', self.on_locate)

    def on_locate(self, request, response):
        time.sleep(0.2)
        self._next += 1
        response.success = True
        response.message = f'bay {self._next % 12}'
        return response


class Terminals(Node):

    def __init__(self, count):
        super().__init__('terminals')
        self._picks = [self.create_client(SetBool, 'pick') for _ in range(count)]
        self._open = [None] * count
        self.create_timer(1.0, self.on_tick)

    def on_tick(self):
        for index, client in enumerate(self._picks):
            if self._open[index] is not None:
                self.get_logger().info(f'terminal {index} has an open order')
                continue
            self._open[index] = client.call_async(SetBool.Request(data=True))
            self._open[index].add_done_callback(
                lambda future, index=index: self.on_picked(index, future))

    def on_picked(self, index, future):
        self._open[index] = None
        self.get_logger().info(f'terminal {index}: {future.result().message}')
