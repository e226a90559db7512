"""A node of asyncio is spun by an executor."""

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.1, self.tick)

    def tick(self):
        print('goes on', flush=True)


rclpy.init()
print('asks', flush=True)
rclpy.spin(Robot('robot'))

# observed: raises
# warned of: CC405
# broken: no starvation, settings have an effect
# undecided: nothing
