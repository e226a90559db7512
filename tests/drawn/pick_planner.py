import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class StockFeed(Node):
    """Replays stock movements of the warehouse management system."""

    SKUS = ('bolt-m4', 'bolt-m6', 'nut-m4', 'washer', 'bracket')

    def __init__(self):
        super().__init__('stock_feed')
        self._pub = self.create_publisher(String, 'stock', 10)
        self._n = 0
        self.create_timer(0.02, self._tick)

    def _tick(self):
        sku = self.SKUS[self._n % len(self.SKUS)]
        self._pub.publish(String(data='%s:%d' % (sku, 10 + self._n % 7)))
        self._n += 1


class ShelfIndex(Node):
    """Keeps the amount of every article on the shelves."""

    def __init__(self):
        super().__init__('shelf_index')
        self._lock = threading.Lock()
        self._amounts = {}
        self._listeners = []
        self.create_subscription(String, 'stock', self._on_stock, 10)

    def add_listener(self, listener):
        self._listeners.append(listener)

    def lookup(self, sku):
        with self._lock:
            return self._amounts.get(sku, 0)

    def _on_stock(self, msg):
        sku, _, amount = msg.data.partition(':')
        with self._lock:
            changed = self._amounts.get(sku) != int(amount)
            self._amounts[sku] = int(amount)
            self._rebuild_bins(sku)
            if changed:
                for listener in self._listeners:
                    listener(sku)

    def _rebuild_bins(self, sku):
        time.sleep(0.004)


class PickPlanner(Node):
    """Plans the next picking tour from open orders and the shelf index."""

    def __init__(self, index):
        super().__init__('pick_planner')
        self._index = index
        self._lock = threading.Lock()
        self._dirty = set()
        self._orders = ['bolt-m4', 'washer', 'bracket']
        self._cycles = 0
        self._pub = self.create_publisher(String, 'tour', 10)
        self.create_timer(0.03, self._plan,
                          callback_group=MutuallyExclusiveCallbackGroup())
        index.add_listener(self.mark_dirty)

    def mark_dirty(self, sku):
        with self._lock:
            self._dirty.add(sku)

    def _plan(self):
        with self._lock:
            tour = []
            for sku in self._orders:
                if sku in self._dirty or not tour:
                    time.sleep(0.002)
                    tour.append('%s=%d' % (sku, self._index.lookup(sku)))
            self._dirty.clear()
        self._pub.publish(String(data=','.join(tour)))
        self._cycles += 1
        if self._cycles % 25 == 0:
            self.get_logger().info('planned %d tours, last %s' % (self._cycles, tour))


def main():
    rclpy.init()
    feed = StockFeed()
    index = ShelfIndex()
    planner = PickPlanner(index)
    executor = MultiThreadedExecutor(num_threads=4)
    for node in (feed, index, planner):
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        for node in (feed, index, planner):
            node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
