"""Driver of a spinning range finder with a reader and a decoder thread."""
import os
import queue
import select
import struct
import threading
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import LaserScan

FRAME = struct.Struct('<8H')


class Port:
    """A serial port made of a pipe, with a device at the other end."""

    def __init__(self):
        self.fd, self._device_fd = os.pipe()
        self._motor = threading.Event()
        self._device = None

    def start_motor(self):
        self._motor.set()
        self._device = threading.Thread(target=self._turn)
        self._device.start()

    def stop_motor(self):
        self._motor.clear()
        self._device.join()

    def _turn(self):
        step = 0
        while self._motor.is_set():
            step += 1
            os.write(self._device_fd, FRAME.pack(*[step % 4000 + i for i in range(8)]))
            time.sleep(0.05)

    def close(self):
        os.close(self._device_fd)
        os.close(self.fd)


class LidarDriver(Node):
    def __init__(self):
        super().__init__('lidar_driver')
        self.declare_parameter('frame_id', 'laser')
        self.frame_id = self.get_parameter('frame_id').value
        self.pub = self.create_publisher(LaserScan, 'scan', 10)
        self.frames = queue.Queue()
        self.running = True
        self.port = Port()
        self.reader = threading.Thread(target=self.read_port)
        self.decoder = threading.Thread(target=self.decode)
        self.reader.start()
        self.decoder.start()
        self.port.start_motor()

    def read_port(self):
        while self.running:
            ready, _, _ = select.select([self.port.fd], [], [], 0.2)
            if ready:
                self.frames.put(os.read(self.port.fd, FRAME.size))

    def decode(self):
        while self.running:
            frame = self.frames.get()
            scan = LaserScan()
            scan.header.frame_id = self.frame_id
            scan.header.stamp = self.get_clock().now().to_msg()
            scan.angle_increment = 0.7854
            scan.range_max = 12.0
            scan.ranges = [v / 1000.0 for v in FRAME.unpack(frame)]
            self.pub.publish(scan)

    def destroy_node(self):
        self.port.stop_motor()
        self.running = False
        self.reader.join()
        self.decoder.join()
        self.port.close()
        super().destroy_node()


class ScanMonitor(Node):
    def __init__(self):
        super().__init__('scan_monitor')
        self.count = 0
        self.create_subscription(LaserScan, 'scan', self.on_scan, 10)

    def on_scan(self, msg):
        self.count += 1


def main():
    rclpy.init()
    driver = LidarDriver()
    monitor = ScanMonitor()
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(driver)
    executor.add_node(monitor)
    end = time.monotonic() + 4.0
    try:
        while rclpy.ok() and time.monotonic() < end:
            executor.spin_once(timeout_sec=0.1)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    monitor.get_logger().info('%d scans' % monitor.count)
    driver.destroy_node()
    monitor.get_logger().info('driver closed')
    monitor.destroy_node()
    rclpy.try_shutdown()


if __name__ == '__main__':
    main()
