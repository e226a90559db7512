"""`main` waits for its map by a spin, before the node serves anybody."""

import threading
import time

import rclpy
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger


class Loader(Node):
    def __init__(self):
        super().__init__('loader', start_parameter_services=False)
        self.create_service(Trigger, 'go', self.on_go)

    def on_go(self, request, response):
        return response


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
    rclpy.spin(node)


if __name__ == '__main__':
    main()
