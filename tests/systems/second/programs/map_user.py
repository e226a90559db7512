"""Gets a map before each step; asks for it in a coroutine."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class MapUser(Node):
    def __init__(self):
        super().__init__('map_user')
        answers = MutuallyExclusiveCallbackGroup()
        self.get_map = self.create_client(Trigger, 'map_server/get_map', callback_group=answers)
        self.create_timer(0.2, self.step)

    async def step(self):
        print('asks', flush=True)
        if not self.get_map.service_is_ready():
            return
        await self.get_map.call_async(Trigger.Request())
        print('goes on', flush=True)


def main():
    rclpy.init()
    rclpy.spin(MapUser())


if __name__ == '__main__':
    main()
