"""A spin with a time-out while a callback awaits: are others served?"""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.task import Future

rclpy.init()
node = rclpy.create_node('harvester')
group = ReentrantCallbackGroup()
executor = SingleThreadedExecutor()
executor.add_node(node)
future = Future()
ticks = []


async def wait() -> None:
    waiting.cancel()
    await future


waiting = node.create_timer(0.01, wait, callback_group=group)
ticking = node.create_timer(0.1, lambda: ticks.append(1), callback_group=group)
executor.spin_until_future_complete(future, timeout_sec=2.0)
print('yes' if len(ticks) > 2 else 'no', flush=True)
