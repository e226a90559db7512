import json

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import BatteryState
from std_msgs.msg import String

from helper_04_backlog import Backlog


class BatteryMonitor(Node):
    """Publishes the state of the battery at a fixed rate."""

    def __init__(self):
        super().__init__('battery_monitor')
        self._voltage = 25.2
        self._pub = self.create_publisher(BatteryState, 'battery', 10)
        self.create_timer(1.0 / 40.0, self._tick)

    def _tick(self):
        self._voltage -= 0.0002
        self._pub.publish(BatteryState(voltage=self._voltage))


class TelemetryUploader(Node):
    """Collects samples and sends them to the fleet server in batches."""

    def __init__(self):
        super().__init__('telemetry_uploader')
        self.declare_parameter('upload_period', 1.0)
        self.declare_parameter('backlog_limit', 32)
        self._backlog = Backlog(self.get_parameter('backlog_limit').value)
        self._sent = 0
        self._pub = self.create_publisher(String, 'uplink', 1)
        self.create_subscription(BatteryState, 'battery', self._on_battery, 10)
        self.create_timer(self.get_parameter('upload_period').value, self._upload)

    def _on_battery(self, msg):
        self._backlog.push_latest(round(msg.voltage, 4))

    def _upload(self):
        batch = self._backlog.drain()
        if not batch:
            return
        self._pub.publish(String(data=json.dumps({'voltage': batch})))
        self._sent += len(batch)
        self.get_logger().info('uploaded %d samples, %d in all' % (len(batch), self._sent))


def main():
    rclpy.init()
    monitor = BatteryMonitor()
    uploader = TelemetryUploader()
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(monitor)
    executor.add_node(uploader)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        monitor.destroy_node()
        uploader.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
