"""A thread makes a future done while nothing else happens: does a spin until then end?"""

import os
import threading

import rclpy
from rclpy.task import Future

PATIENCE_S = 3.0

rclpy.init()
node = rclpy.create_node('waiter', start_parameter_services=False)
future = Future()
ended = threading.Event()


def wait() -> None:
    rclpy.spin_until_future_complete(node, future)
    ended.set()


threading.Thread(target=wait, daemon=True).start()
# Not before it waits.
ended.wait(0.5)
future.set_result(None)
print('yes' if ended.wait(PATIENCE_S) else 'no', flush=True)
os._exit(0)
