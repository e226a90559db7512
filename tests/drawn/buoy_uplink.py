import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty, Float32


class Modem:
    """Slow link to the shore."""

    def __init__(self, seconds_per_packet):
        self._seconds = seconds_per_packet
        self.sent = 0

    def send(self, payload):
        time.sleep(self._seconds)
        self.sent += 1
        return len(payload)


class Buoy(Node):

    def __init__(self):
        super().__init__('buoy')
        self.declare_parameter('packet_seconds', 1.4)
        self._modem = Modem(self.get_parameter('packet_seconds').value)
        self._alive = self.create_publisher(Empty, 'buoy/alive', 10)
        self._sensor_group = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.2, self.beat)
        self.create_subscription(Float32, 'temperature', self.uplink, 1)

    def beat(self):
        self._alive.publish(Empty())

    def uplink(self, msg):
        packet = 'T%.2f' % msg.data
        self._modem.send(packet)
        self.get_logger().info('sent %s (%d)' % (packet, self._modem.sent))


class Thermometer(Node):

    def __init__(self):
        super().__init__('thermometer')
        self._value = 11.0
        self._pub = self.create_publisher(Float32, 'temperature', 10)
        self.create_timer(2.0, self.sample)

    def sample(self):
        self._value += 0.25
        self._pub.publish(Float32(data=self._value))


class HarbourWatch(Node):
    """Raises the alarm when the buoy is silent."""

    PATIENCE = 0.8

    def __init__(self):
        super().__init__('harbour_watch')
        self._last = None
        self._lost = False
        self.create_subscription(Empty, 'buoy/alive', self.on_alive, 10)
        self.create_timer(0.1, self.check)
        self.create_timer(2.0, self.report)

    def on_alive(self, msg):
        self._last = time.monotonic()
        if self._lost:
            self._lost = False
            self.get_logger().info('buoy back')

    def check(self):
        if self._last is None or self._lost:
            return
        if time.monotonic() - self._last > self.PATIENCE:
            self._lost = True
            self.get_logger().warning('buoy lost')

    def report(self):
        self.get_logger().info('watch: %s' % ('lost' if self._lost else 'fine'))


def main():
    rclpy.init()
    nodes = [Buoy(), Thermometer(), HarbourWatch()]
    executor = MultiThreadedExecutor(num_threads=4)
    for node in nodes:
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown(timeout_sec=2.0)
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
