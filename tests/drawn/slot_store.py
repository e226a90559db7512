"""Storage rack: robots book slots, bookings which are too old are given back."""
import threading
import time

import rclpy
from helper_10_sync import synchronized
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32
from std_srvs.srv import Trigger


class SlotStore:
    def __init__(self, size, max_age):
        self.guard = threading.Lock()
        self.max_age = max_age
        self.free = list(range(size))
        self.booked = {}

    @synchronized
    def book(self):
        if not self.free:
            return None
        slot = self.free.pop(0)
        self.booked[slot] = time.monotonic()
        return slot

    @synchronized
    def give_back(self, slot):
        if self.booked.pop(slot, None) is not None:
            self.free.append(slot)

    @synchronized
    def purge(self):
        limit = time.monotonic() - self.max_age
        for slot in [s for s, since in self.booked.items() if since < limit]:
            self.give_back(slot)
        return len(self.free)


class RackNode(Node):
    def __init__(self):
        super().__init__('rack')
        self.store = SlotStore(size=6, max_age=1.5)
        self.pub = self.create_publisher(Int32, 'rack/free', 10)
        self.create_service(
            Trigger, 'rack/book', self.on_book,
            callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.25, self.on_purge)

    def on_book(self, request, response):
        slot = self.store.book()
        response.success = slot is not None
        response.message = 'slot %s' % slot if response.success else 'full'
        return response

    def on_purge(self):
        self.pub.publish(Int32(data=self.store.purge()))


class Shuttle(Node):
    def __init__(self):
        super().__init__('shuttle')
        self.answers = 0
        self.client = self.create_client(Trigger, 'rack/book')
        self.create_timer(0.4, self.ask)
        self.create_subscription(Int32, 'rack/free', self.on_free, 10)

    def ask(self):
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)

    def on_answer(self, future):
        self.answers += 1
        self.get_logger().info('answer %d: %s' % (self.answers, future.result().message))

    def on_free(self, msg):
        self.get_logger().info('%d slots free' % msg.data)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    for node in (RackNode(), Shuttle()):
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
