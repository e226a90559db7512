"""A subscription whose callback has a second parameter: does it get something for it?"""

import os
import threading

import rclpy
from std_msgs.msg import String

PATIENCE_S = 5.0

rclpy.init()
node = rclpy.create_node('informed')
publisher = node.create_publisher(String, 'words', 10)
told = []


def hear(message: String, info: object) -> None:
    told.append(info is not None)


node.create_subscription(String, 'words', hear, 10)
node.create_timer(0.05, lambda: publisher.publish(String()))
threading.Timer(PATIENCE_S, lambda: os._exit(1)).start()
try:
    while not told:
        rclpy.spin_once(node)
except TypeError:
    told.append(False)
print('yes' if told[0] else 'no', flush=True)
os._exit(0)
