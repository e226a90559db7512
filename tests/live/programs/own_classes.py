"""A group class and an executor class that rclpy does not know, and a group that refuses."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import SingleThreadedExecutor


class CountingGroup(MutuallyExclusiveCallbackGroup):
    """Counts its executions."""

    def __init__(self) -> None:
        super().__init__()
        self.begun = 0

    def beginning_execution(self, entity: object) -> bool:
        self.begun += 1
        return super().beginning_execution(entity)


class PatientExecutor(SingleThreadedExecutor):
    """Runs a given number of callbacks."""

    def run(self, times: int) -> None:
        for _ in range(times):
            self.spin_once()


rclpy.init()
node = rclpy.create_node('careful')
group = CountingGroup()
timer = node.create_timer(0.01, lambda: None, callback_group=group)
executor = PatientExecutor()
executor.add_node(node)
executor.run(5)
print('begun', group.begun)
rclpy.shutdown()
