"""A thread makes a future done while nothing else happens: does the callback go on?"""

import os
import threading
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.task import Future

PATIENCE_S = 3.0

rclpy.init()
node = rclpy.create_node('waker', start_parameter_services=False)
executor = SingleThreadedExecutor()
executor.add_node(node)
future = Future()
waits, goes_on = threading.Event(), threading.Event()


async def wait() -> None:
    timer.cancel()
    waits.set()
    await future
    goes_on.set()


timer = node.create_timer(0.01, wait)
threading.Thread(target=executor.spin, daemon=True).start()
waits.wait()
time.sleep(0.5)
future.set_result(None)
print('yes' if goes_on.wait(PATIENCE_S) else 'no', flush=True)
os._exit(0)
