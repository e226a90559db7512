"""P18: a node in an attribute that is None before it is made and after it is gone."""
# live: no, nobody calls the methods

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Bridge:
    def __init__(self):
        self._node = None
        self._clients = {}

    def open(self):
        self._node = Node('bridge')
        executor = SingleThreadedExecutor()
        executor.add_node(self._node)
        threading.Thread(target=executor.spin).start()

    def close(self):
        self._node.destroy_node()
        self._node = None

    def node(self):
        if self._node is None:
            raise RuntimeError('not open')
        return self._node

    def client(self, name):
        if name not in self._clients:
            self._clients[name] = self.node().create_client(Trigger, name)
        return self._clients[name]

    def call(self):
        self.client('go').call_async(Trigger.Request())


def main():
    rclpy.init()
    bridge = Bridge()
    bridge.open()
    bridge.close()


if __name__ == '__main__':
    main()

# expect:
# unit bridge: SingleThreadedExecutor x1 spin in thread, main
#   group bridge_default EXCLUSIVE default
#   client go_client in bridge_default key=go conditional when=later
#   activity main main
#     reads Bridge._node @45>24
#     writes Bridge._node clears @45>25
