"""Collects diagnostic dumps from a vendor tool and republishes a digest."""
import subprocess
import sys

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Header, String

VENDOR_TOOL = (
    'import sys\n'
    'n = int(sys.argv[1])\n'
    'for i in range(n):\n'
    '    print(f"{i:08d} drive={i % 6} temp={30 + i % 20} flags=0x0000 state=RUN")\n'
)


class LogCollector(Node):

    def __init__(self):
        super().__init__('log_collector')
        self.declare_parameter('period', 1.0)
        self.declare_parameter('lines_per_minute', 400)
        self._rounds = 0
        self._child = None
        self._digest = self.create_publisher(String, 'diagnostics/digest', 10)
        self._beat = self.create_publisher(Header, 'heartbeat', 10)
        self.create_timer(self.get_parameter('period').value, self._collect,
                          callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.5, self._on_beat, callback_group=MutuallyExclusiveCallbackGroup())

    def _dump(self, lines):
        cmd = [sys.executable, '-c', VENDOR_TOOL, str(lines)]
        self._child = subprocess.Popen(cmd, stdout=subprocess.PIPE, text=True)
        code = self._child.wait()
        if code != 0:
            raise RuntimeError(f'vendor tool failed with {code}')
        return self._child.stdout.read().splitlines()

    def _collect(self):
        self._rounds += 1
        try:
            rows = self._dump(self._rounds * self.get_parameter('lines_per_minute').value)
        except (RuntimeError, OSError) as err:
            self.get_logger().error(str(err))
            return
        hot = sum(1 for row in rows if 'temp=4' in row)
        self._digest.publish(String(data=f'{hot}/{len(rows)}'))
        self.get_logger().info(f'round {self._rounds}: {len(rows)} rows, {hot} hot')

    def _on_beat(self):
        self._beat.publish(Header(stamp=self.get_clock().now().to_msg(), frame_id='collector'))

    def close(self):
        if self._child is not None and self._child.poll() is None:
            self._child.kill()


def main():
    rclpy.init()
    collector = LogCollector()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(collector)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        collector.close()
        executor.shutdown(timeout_sec=2.0)
        collector.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
