"""`main` spins until a thread has done its work; the timer that would end that is cancelled."""

import threading
import time

import rclpy
from rclpy.node import Node
from rclpy.task import Future


class Loader(Node):
    def __init__(self):
        super().__init__('loader', start_parameter_services=False)
        self.retry = self.create_timer(0.2, self.on_retry)
        self.retry.cancel()

    def on_retry(self):
        print('again', flush=True)


def load(done):
    time.sleep(0.5)
    done.set_result('map')


def main():
    rclpy.init()
    node = Loader()
    done = Future()
    threading.Thread(target=load, args=(done,), daemon=True).start()
    # differs: until-asks-future
    rclpy.spin_until_future_complete(node, done)
    print('loaded', flush=True)


if __name__ == '__main__':
    main()
