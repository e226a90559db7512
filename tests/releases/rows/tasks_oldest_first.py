"""Two tasks made in one callback: does the first run first?"""

import rclpy
from rclpy.executors import SingleThreadedExecutor

rclpy.init()
node = rclpy.create_node('tasks')
executor = SingleThreadedExecutor()
executor.add_node(node)
ran = []


def make() -> None:
    timer.cancel()
    executor.create_task(lambda: ran.append('first'))
    executor.create_task(lambda: ran.append('second'))


timer = node.create_timer(0.01, make)
while len(ran) < 2:
    executor.spin_once(timeout_sec=0.1)
print('yes' if ran[0] == 'first' else 'no', flush=True)
