import threading

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import (
    ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor)
from rclpy.node import Node
from std_msgs.msg import Int32
from std_srvs.srv import SetBool, Trigger

from helper_08_orders import ShelfIndex, Terminals, wait_for


class OrderPicker(Node):

    def __init__(self):
        super().__init__('order_picker')
        self._lock = threading.Lock()
        self._picked = 0
        group = ReentrantCallbackGroup()
        self._shelves = self.create_client(
            Trigger, 'shelf/locate', callback_group=group)
        self.create_service(SetBool, 'pick', self.on_pick, callback_group=group)
        self._count_pub = self.create_publisher(Int32, 'picked', 10)
        self.create_timer(0.5, self.on_report)

    def on_report(self):
        with self._lock:
            picked = self._picked
        self._count_pub.publish(Int32(data=picked))

    def on_pick(self, request, response):
        self.get_logger().info('pick order')
        place = wait_for(self._shelves.call_async(Trigger.Request()))
        with self._lock:
            self._picked += 1
            number = self._picked
        response.success = place.success
        response.message = f'item {number} from {place.message}'
        return response


def main():
    rclpy.init()
    side = SingleThreadedExecutor()
    side.add_node(ShelfIndex())
    side.add_node(Terminals(3))
    threading.Thread(target=side.spin, daemon=True).start()
    picker = OrderPicker()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(picker)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
