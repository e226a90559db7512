"""A call that nobody answers in time: does it raise?"""

import os
import threading

import rclpy
from std_srvs.srv import Empty

rclpy.init()
node = rclpy.create_node('caller')
client = node.create_client(Empty, 'nobody')
threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
try:
    answer = client.call(Empty.Request(), timeout_sec=0.3)
except TimeoutError:
    print('yes', flush=True)
except TypeError:  # there is no time-out
    print('no', flush=True)
else:
    print('no' if answer is None else answer, flush=True)
os._exit(0)
