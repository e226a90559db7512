import time

import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node
from sensor_msgs.msg import LaserScan


class ScanFilter(LifecycleNode):

    def __init__(self):
        super().__init__('scan_filter')
        self._first = None
        self._sub = None
        self._pub = None
        self._scan_group = MutuallyExclusiveCallbackGroup()

    def on_configure(self, state):
        self._pub = self.create_lifecycle_publisher(LaserScan, 'scan_filtered', 10)
        self._sub = self.create_subscription(LaserScan, 'scan', self.on_scan, 10)
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state):
        self._first = None
        self.get_logger().info('waiting for the lidar')
        while rclpy.ok() and self._first is None:
            time.sleep(0.05)
        self.get_logger().info(f'{len(self._first.ranges)} beams')
        return super().on_activate(state)

    def on_cleanup(self, state):
        self.destroy_subscription(self._sub)
        self.destroy_lifecycle_publisher(self._pub)
        self._first = None
        return TransitionCallbackReturn.SUCCESS

    def on_scan(self, scan):
        if self._first is None:
            self._first = scan
        scan.ranges = [r if r < scan.range_max else 0.0 for r in scan.ranges]
        self._pub.publish(scan)


class Lidar(Node):

    def __init__(self):
        super().__init__('lidar')
        self._pub = self.create_publisher(LaserScan, 'scan', 10)
        self.create_timer(0.2, self.on_tick)

    def on_tick(self):
        self._pub.publish(LaserScan(range_max=10.0, ranges=[1.0, 4.0, 12.0]))


class Bringup(Node):

    def __init__(self):
        super().__init__('bringup')
        self._client = self.create_client(ChangeState, 'scan_filter/change_state')
        self._steps = [Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE]
        self._pending = None
        self.create_timer(0.5, self.on_tick)

    def on_tick(self):
        if self._pending is not None:
            if not self._pending.done():
                self.get_logger().info('transition still running')
                return
            self.get_logger().info(f'transition ok: {self._pending.result().success}')
            self._pending = None
        if self._steps and self._client.service_is_ready():
            request = ChangeState.Request()
            request.transition.id = self._steps.pop(0)
            self._pending = self._client.call_async(request)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    nodes = [ScanFilter(), Lidar(), Bringup()]
    for node in nodes:
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
