"""A coroutine that waits for another callback of its node, on a pool of two threads."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future


class Patient(Node):
    """Waits in one group until the other has ticked five times."""

    def __init__(self) -> None:
        super().__init__('patient')
        self.ticks = 0
        self.ready, self.over = Future(), Future()
        self.once = self.create_timer(
            0.01, self.await_readiness, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.ticking = self.create_timer(0.01, self.tick)

    async def await_readiness(self) -> None:
        self.once.cancel()
        await self.ready
        self.over.set_result(None)

    def tick(self) -> None:
        self.ticks += 1
        if self.ticks == 5:
            # Nothing but the coroutine may run when the executor is shut down.
            self.ticking.cancel()
            self.ready.set_result(None)


rclpy.init()
node = Patient()
executor = MultiThreadedExecutor(2)
executor.add_node(node)
executor.spin_until_future_complete(node.over)
print('ticks', node.ticks >= 5)
executor.shutdown()
node.destroy_node()
rclpy.shutdown()
