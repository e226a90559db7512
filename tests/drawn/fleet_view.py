"""Keeps a live picture of the fleet and streams it to the dashboard as JSON."""
import json
import socket
import threading
import time

import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

MODEM_GAP = 0.0005


class Fleet(Node):
    """Robots that come and go."""

    def __init__(self):
        super().__init__('fleet')
        self._pub = self.create_publisher(PoseStamped, 'poses', 50)
        self._n = 0
        self.create_timer(0.01, self._tick)

    def _tick(self):
        self._n += 1
        msg = PoseStamped()
        msg.header.frame_id = f'robot_{self._n % 30 + self._n // 10}'
        msg.header.stamp = self.get_clock().now().to_msg()
        msg.pose.position.x = 0.1 * self._n
        self._pub.publish(msg)


class DashboardLink(threading.Thread):
    """Sends what the view holds, some times a second, over a stream socket."""

    def __init__(self, robots, sock, period=0.05):
        super().__init__(name='dashboard', daemon=True)
        self._robots = robots
        self._sock = sock
        self._period = period
        self._quit = threading.Event()
        self.sent = 0

    def run(self):
        while not self._quit.wait(self._period):
            for name, entry in self._robots.items():
                line = json.dumps({'robot': name, 'x': entry[0], 'y': entry[1]})
                self._sock.sendall(line.encode() + b'\n')
                time.sleep(MODEM_GAP)
            self.sent += 1

    def stop(self):
        self._quit.set()
        self.join(timeout=1.0)


class FleetView(Node):

    STALE = 0.6

    def __init__(self, sock):
        super().__init__('fleet_view')
        self._robots = {}
        self._link = DashboardLink(self._robots, sock)
        self.create_subscription(PoseStamped, 'poses', self._on_pose, 50)
        self.create_timer(0.1, self._expire)
        self.create_timer(1.0, self._stats)
        self._link.start()

    def _on_pose(self, msg):
        p = msg.pose.position
        self._robots[msg.header.frame_id] = (p.x, p.y, time.monotonic())

    def _expire(self):
        limit = time.monotonic() - self.STALE
        for name in [n for n, e in self._robots.items() if e[2] < limit]:
            del self._robots[name]

    def _stats(self):
        self.get_logger().info(f'{len(self._robots)} robots, {self._link.sent} pictures sent')

    def close(self):
        self._link.stop()


def drain(sock):
    while sock.recv(65536):
        time.sleep(0.001)


def main():
    rclpy.init()
    here, there = socket.socketpair()
    threading.Thread(target=drain, args=(there,), daemon=True).start()
    view, fleet = FleetView(here), Fleet()
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(view)
    executor.add_node(fleet)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        view.close()
        here.close()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
