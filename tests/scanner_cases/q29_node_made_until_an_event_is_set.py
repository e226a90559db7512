"""An event that the set-up sets says that the node is there already."""

import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

shared = None
ready = threading.Event()
lock = threading.Lock()


def make():
    global shared
    shared = Node('backend')
    ready.set()


def get_node():
    if not ready.is_set():
        with lock:
            if not ready.is_set():
                make()
    return shared


def on_text(msg):
    pass


def tick():
    if ready.is_set():
        get_node().create_subscription(String, 'late', on_text, 10)


def main():
    rclpy.init()
    get_node().create_subscription(String, 'text', on_text, 10)
    get_node().create_timer(1.0, tick)
    rclpy.spin(get_node())


# expect:
# unit backend: SingleThreadedExecutor x1 rclpy.spin, main
#   group backend_default EXCLUSIVE default
#   timer tick in backend_default every 1
#     locks lock @34>22
#     changes subscription @34
#   subscription text_on_text in backend_default (on_text) key=text
#   subscription late_on_text in backend_default (on_text) key=late conditional count=? when=callback
#   ? late_on_text count
