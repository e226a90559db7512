import threading

import rclpy
from rclpy.node import Node

node = None


def get_node():
    global node
    if node is None:
        rclpy.init()
        node = Node('panel')
        threading.Thread(target=rclpy.spin, args=(node,)).start()
    return node


def client_of(kind, name):
    return get_node().create_client(kind, name)
