"""Battery monitor: reads the cells of a pack one after the other and reports them together."""
import threading
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import BatteryState

CELLS = 6


class Gauge:
    """Stands in for the chip that measures one cell at a time."""

    def __init__(self):
        self.sample = 0

    def next_sample(self):
        self.sample += 1

    def voltage(self, cell):
        time.sleep(0.002)
        return 3.0 + 0.001 * (self.sample % 1000)


class BatteryMonitor(Node):

    def __init__(self):
        super().__init__('battery_monitor')
        self.gauge = Gauge()
        self.battery = BatteryState()
        self.battery.cell_voltage = [0.0] * CELLS
        self.pub = self.create_publisher(BatteryState, 'battery', 10)
        self.create_timer(0.05, self.report)
        threading.Thread(target=self.measure, daemon=True).start()

    def measure(self):
        while rclpy.ok():
            self.gauge.next_sample()
            cells = self.battery.cell_voltage
            for cell in range(CELLS):
                cells[cell] = self.gauge.voltage(cell)
            time.sleep(0.01)

    def report(self):
        self.battery.header.stamp = self.get_clock().now().to_msg()
        self.pub.publish(self.battery)


def main():
    rclpy.init()
    node = BatteryMonitor()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
