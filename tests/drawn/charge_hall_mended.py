import threading

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int64

from helper_09_ledger_v2 import EnergyLedger


class Charger(Node):
    """Books a fixed portion of energy with every tick of its meter."""

    PORTION = 5

    def __init__(self, name, ledger, portions):
        super().__init__(name)
        self._ledger = ledger
        self._portions = portions
        self.booked = 0
        self._pub = self.create_publisher(Int64, 'energy_total', 10)
        self._meter = self.create_timer(0.001, self._on_meter)

    def done(self):
        return self.booked >= self._portions * self.PORTION

    def _on_meter(self):
        total = 0
        for _ in range(20):
            total = self._ledger.book(self.PORTION)
            self.booked += self.PORTION
        self._pub.publish(Int64(data=total))
        if self.done():
            self._meter.cancel()
            self.get_logger().info('%d J booked' % self.booked)


class Accountant(Node):
    """Closes the day once all chargers are through."""

    def __init__(self, ledger, chargers):
        super().__init__('accountant')
        self._ledger = ledger
        self._chargers = chargers
        self._timer = self.create_timer(0.5, self._check)

    def _check(self):
        if not all(charger.done() for charger in self._chargers):
            return
        self._timer.cancel()
        booked = sum(charger.booked for charger in self._chargers)
        self.get_logger().info('chargers booked %d J, ledger says %d J'
                               % (booked, self._ledger.total))


def spin_in_thread(node):
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    return executor, thread


def main():
    rclpy.init()
    ledger = EnergyLedger()
    chargers = [Charger('charger_%d' % n, ledger, 8000) for n in range(3)]
    running = [spin_in_thread(charger) for charger in chargers]
    accountant = Accountant(ledger, chargers)
    try:
        rclpy.spin(accountant)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        for executor, thread in running:
            executor.shutdown()
            thread.join()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
