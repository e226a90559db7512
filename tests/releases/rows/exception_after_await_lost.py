"""A callback awaits and raises on one thread: is the exception lost?"""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.task import Future

rclpy.init()
node = rclpy.create_node('raiser')
group = ReentrantCallbackGroup()
executor = SingleThreadedExecutor()
executor.add_node(node)
future = Future()
came = []


async def fail() -> None:
    failing.cancel()
    await future
    came.append('here')
    raise ValueError


failing = node.create_timer(0.01, fail, callback_group=group)


def release() -> None:
    releasing.cancel()
    future.set_result(None)


releasing = node.create_timer(0.2, release, callback_group=group)
lost = True
for _ in range(20):
    try:
        executor.spin_once(timeout_sec=0.1)
    except ValueError:
        lost = False
assert came == ['here']
print('yes' if lost else 'no', flush=True)
