"""Each handler is called while another thread holds it, as the next lap of the executor may."""

import rclpy
from rclpy.executors import MultiThreadedExecutor

rclpy.init()
node = rclpy.create_node('busy')
executor = MultiThreadedExecutor(num_threads=2)
submit = executor._executor.submit


def in_vain_before(function, *args):
    if hasattr(function, '_task_lock'):
        with function._task_lock:
            function()
    return submit(function, *args)


executor._executor.submit = in_vain_before
ticks = []


def tick():
    ticks.append(0)


node.create_timer(0.01, tick)
executor.add_node(node)
while len(ticks) < 3:
    executor.spin_once()
executor.shutdown()
