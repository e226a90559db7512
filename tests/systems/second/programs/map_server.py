"""Serves its map under its own name."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class MapServer(Node):
    def __init__(self):
        super().__init__('map_server')
        self.create_service(Trigger, '~/get_map', self.on_get)

    def on_get(self, request, response):
        response.success = True
        return response


def main():
    rclpy.init()
    rclpy.spin(MapServer())


if __name__ == '__main__':
    main()
