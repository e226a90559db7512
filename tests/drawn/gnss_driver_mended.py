"""Publishes the fixes of a serial GNSS receiver."""
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Optional, Tuple

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import NavSatFix
from std_msgs.msg import UInt32

from helper_16_serial import FakeSerial


class FixParser:
    """Turns one line into latitude and longitude."""

    def __init__(self) -> None:
        self.bad_lines = 0

    def parse(self, line: bytes) -> Optional[Tuple[float, float]]:
        fields = line.decode('ascii', errors='replace').strip().split(',')
        if len(fields) != 3 or fields[0] != '$FIX':
            self.bad_lines += 1
            return None
        try:
            return float(fields[1]), float(fields[2])
        except ValueError:
            self.bad_lines += 1
            return None


class GnssDriver(Node):

    def __init__(self) -> None:
        super().__init__('gnss_driver')
        device = self.declare_parameter('device', '/dev/ttyUSB0').value
        self._port = FakeSerial(device)
        self._parser = FixParser()
        self._fixes = 0
        self._fix_pub = self.create_publisher(NavSatFix, 'fix', 10)
        self._count_pub = self.create_publisher(UInt32, 'fix_count', 10)
        self.create_timer(0.5, self._report)
        self._pool = ThreadPoolExecutor(max_workers=1, thread_name_prefix='gnss')
        self._reader: Future = self._pool.submit(self._read_loop)

    def _read_loop(self) -> None:
        while self._port.is_open:
            line = self._port.readline()
            if not line:
                continue
            fix = self._parser.parse(line)
            if fix is not None:
                self._publish(*fix)

    def _publish(self, latitude: float, longitude: float) -> None:
        msg = NavSatFix()
        msg.header.stamp = self.get_clock().now().to_msg()
        msg.header.frame_id = 'gnss'
        msg.latitude, msg.longitude = latitude, longitude
        self._fix_pub.publish(msg)
        self._fixes += 1

    def _report(self) -> None:
        self._count_pub.publish(UInt32(data=self._fixes))

    def close(self) -> None:
        self._port.close()
        self._port.cancel_read()
        self._pool.shutdown(wait=True)


def main() -> None:
    rclpy.init()
    node = GnssDriver()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.close()
        node.destroy_node()
        rclpy.try_shutdown()
        print('driver closed', flush=True)


if __name__ == '__main__':
    main()
