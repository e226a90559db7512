"""Spraying mission: switches the nozzles one after the other and waits for each."""
import threading
import time

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32


class RelayBoard(Node):
    """Confirms each relay which it has switched."""

    def __init__(self):
        super().__init__('relay_board')
        self.confirm = self.create_publisher(Int32, 'relay/confirm', 10)
        self.create_subscription(Int32, 'relay/switch', self.on_switch, 10)

    def on_switch(self, msg):
        self.confirm.publish(msg)


class Nozzles(Node):
    SETTLE = 0.05

    def __init__(self):
        super().__init__('nozzles')
        self.confirmed = threading.Event()
        self.pub = self.create_publisher(Int32, 'relay/switch', 10)
        self.create_subscription(Int32, 'relay/confirm', self.on_confirm, 10)

    def on_confirm(self, msg):
        self.confirmed.set()

    def ready(self):
        return self.pub.get_subscription_count() > 0 and \
            self.count_publishers('relay/confirm') > 0

    def switch(self, number):
        self.confirmed.clear()
        self.pub.publish(Int32(data=number))
        time.sleep(self.SETTLE)
        self.get_logger().info('nozzle %d commanded' % number)
        if self.confirmed.wait(timeout=2.0):
            self.get_logger().info('nozzle %d confirmed' % number)
        else:
            self.get_logger().error('nozzle %d not confirmed' % number)


def spin(executor):
    try:
        executor.spin()
    except ExternalShutdownException:
        pass


def main():
    rclpy.init()
    nozzles = Nozzles()
    executor = SingleThreadedExecutor()
    executor.add_node(nozzles)
    executor.add_node(RelayBoard())
    spinner = threading.Thread(target=spin, args=(executor,), daemon=True)
    spinner.start()
    while rclpy.ok() and not nozzles.ready():
        time.sleep(0.1)
    time.sleep(0.5)
    for number in range(1, 7):
        if not rclpy.ok():
            break
        nozzles.switch(number)
        time.sleep(0.3)
    nozzles.get_logger().info('mission over')
    rclpy.try_shutdown()
    spinner.join()


if __name__ == '__main__':
    main()
