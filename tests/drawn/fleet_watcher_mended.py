"""Fleet watcher: the names heard in the last seconds, as one line."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

from helper_11_registry import Registry


class FleetWatcher(Node):
    """Hears the robots, and says who is there."""

    def __init__(self):
        super().__init__('fleet_watcher')
        self.registry = Registry(ttl=0.05)
        self.lines = 0
        self.create_subscription(
            String, 'hello', self.on_hello, 50, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.summary = self.create_publisher(String, 'fleet', 10)
        self.create_timer(0.01, self.on_tick, callback_group=MutuallyExclusiveCallbackGroup())

    def on_hello(self, msg):
        self.registry.touch(msg.data)
        self.registry.prune()

    def _words(self):
        with self.registry.locked() as registry:
            for name, heard in registry.peers.items():
                yield f'{name}@{heard:.3f}'

    def on_tick(self):
        self.summary.publish(String(data=' '.join(self._words())))
        self.lines += 1


def main():
    rclpy.init()
    node = FleetWatcher()
    executor = MultiThreadedExecutor()
    executor.add_node(node)
    executor.spin()
    rclpy.shutdown()


if __name__ == '__main__':
    main()
