import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

node = None


def get_node():
    global node
    if node is None:
        rclpy.init()
        node = Node('web')
        threading.Thread(target=rclpy.spin, args=(node,)).start()
    return node


def client_of(kind, name):
    return get_node().create_client(kind, name)


class Handler:
    def __init__(self, socket):
        self.socket = socket
        self.node = get_node()

    def forward(self, topic):
        self.node.create_subscription(String, topic, self.on_message, 10)

    def on_message(self, msg):
        pass
