"""A node that is made only while there is none is one node, no matter what asks for it first."""
# live: no, no known code turns the lamp on

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

shared = None
ready = threading.Event()


def spin():
    executor = SingleThreadedExecutor()
    executor.add_node(shared)
    executor.spin()


def get_node():
    global shared
    if not ready.is_set():
        rclpy.init()
        shared = Node('backend')
        threading.Thread(target=spin, daemon=True).start()
        ready.set()
    return shared


class Lamp:
    def __init__(self):
        self.pub = None

    def show(self):
        if self.pub is None:
            self.pub = get_node().create_publisher(String, 'lamp', 1)
            get_node().create_timer(0.5, self.show)
        self.pub.publish(String())

    def turn_on(self):
        self.show()


class Door:
    def listen(self):
        get_node().create_subscription(String, 'door', self.heard, 10)

    def heard(self, msg):
        get_node().get_logger().info('knock')


lamp = Lamp()
door = Door()

# expect:
# unit backend: SingleThreadedExecutor x1 spin in thread, spin
#   group backend_default EXCLUSIVE default
#   timer show in backend_default every 0.5 when=later
#     reads Lamp.pub @36
#     reads q29_node_made_when_it_is_missing.shared @37>28
#     reads q29_node_made_when_it_is_missing.shared under Lamp.pub (flag) @38>28
#     reads Lamp.pub @39
#     writes Lamp.pub rests later under Lamp.pub (flag) @37
#     publishes lamp conditional @39
#     changes timer holding Lamp.pub (flag) @38
#   subscription heard in backend_default key=door conditional when=later
#     reads q29_node_made_when_it_is_missing.shared @50>28
