"""E42: the set-up waits for what nobody ends, or callbacks that nobody serves meanwhile."""
# live: no, it waits forever

import queue
import signal
import threading

import rclpy
from rclpy.node import Node
from rclpy.task import Future


class Station(Node):
    def __init__(self):
        super().__init__('station')
        self.arrived = threading.Event()
        self.opened = threading.Event()
        self.trains = queue.Queue()
        self.finished, self.done = Future(), Future()
        self.create_timer(0.3, self.on_train)

    def on_train(self):
        self.arrived.set()
        self.trains.put(1)
        self.done.set_result(True)

    def open(self, *args):
        self.opened.set()


def main():
    rclpy.init()
    node = Station()
    signal.signal(signal.SIGUSR1, node.open)
    node.opened.wait()
    node.arrived.wait(timeout=1.0)
    node.arrived.wait()
    node.trains.get()
    rclpy.spin_until_future_complete(node, node.done)
    rclpy.spin_until_future_complete(node, node.finished)


if __name__ == '__main__':
    main()


# expect:
# unit station: SingleThreadedExecutor x1 rclpy.spin_until_future_complete, main
#   group station_default EXCLUSIVE default
#   timer on_train in station_default every 0.3
#     writes trains update in_place @24
# error nobody-spins @37
# error nobody-spins @38
# warning nobody-spins @40
