"""Gives the map after asking where the robot is; its client has a thread of its own."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Finder(Node):
    def __init__(self):
        super().__init__('finder')
        self.pose = self.create_client(Trigger, '/localizer/pose')


class Mapper(Node):
    def __init__(self, finder):
        super().__init__('mapper')
        self.finder = finder
        self.create_service(Trigger, '~/map', self.give_map)

    def give_map(self, request, response):
        self.finder.pose.call(Trigger.Request())
        response.success = True
        return response


def main():
    rclpy.init()
    finder = Finder()
    mapper = Mapper(finder)
    finder.pose.wait_for_service()
    beside = SingleThreadedExecutor()
    beside.add_node(finder)
    threading.Thread(target=beside.spin, daemon=True).start()
    rclpy.spin(mapper)


if __name__ == '__main__':
    main()
