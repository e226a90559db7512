"""Keeps an occupancy grid, stores it on request and sends a heartbeat."""
from typing import Optional

import rclpy
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import Header, UInt32
from std_srvs.srv import Trigger

from helper_17_flash import FlashStore


class MapKeeper(Node):

    def __init__(self) -> None:
        super().__init__('map_keeper')
        self._store = FlashStore()
        self._grid: Optional[OccupancyGrid] = None
        self._updates = 0
        self._saves = 0
        self._beat_pub = self.create_publisher(Header, 'heartbeat', 10)
        self._updates_pub = self.create_publisher(UInt32, 'map_updates', 10)
        self.create_subscription(OccupancyGrid, 'map', self._on_map, 1)
        self.create_service(Trigger, 'save_map', self._on_save)
        self.create_timer(0.1, self._on_beat)

    def _on_map(self, msg: OccupancyGrid) -> None:
        self._grid = msg
        self._updates += 1
        self._updates_pub.publish(UInt32(data=self._updates))

    def _on_beat(self) -> None:
        beat = Header()
        beat.stamp = self.get_clock().now().to_msg()
        beat.frame_id = self.get_name()
        self._beat_pub.publish(beat)

    def _on_save(self, _request: Trigger.Request, response: Trigger.Response):
        grid = self._grid
        if grid is None:
            response.success = False
            response.message = 'no map yet'
            return response
        self._saves += 1
        size = self._store.save(f'map_{self._saves}.pgm', self._encode(grid))
        response.success = True
        response.message = f'{size} bytes'
        return response

    @staticmethod
    def _encode(grid: OccupancyGrid) -> bytes:
        head = f'P5 {grid.info.width} {grid.info.height} 255\n'.encode()
        body = bytes(205 if cell < 0 else 254 - 2 * cell for cell in grid.data)
        return head + body


def main() -> None:
    rclpy.init()
    node = MapKeeper()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
