"""`main` spins until a thread has done its work, with nothing else to do."""

import threading
import time

import rclpy
from rclpy.node import Node
from rclpy.task import Future


def load(done):
    time.sleep(0.5)
    done.set_result('map')


def main():
    rclpy.init()
    node = Node('loader', start_parameter_services=False)
    done = Future()
    threading.Thread(target=load, args=(done,), daemon=True).start()
    # differs: until-asks-future
    rclpy.spin_until_future_complete(node, done)
    print('loaded', flush=True)


if __name__ == '__main__':
    main()
