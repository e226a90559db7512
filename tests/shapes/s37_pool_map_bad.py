"""A callback maps calls over a pool whose answers need the callback's only thread."""

from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class Survey(Node):
    def __init__(self):
        super().__init__('survey')
        self.pool = ThreadPoolExecutor(max_workers=2)
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'probe', callback_group=group)
        self.create_service(Trigger, 'probe', self.on_probe, callback_group=group)
        self.create_timer(0.5, self.survey)

    def survey(self):
        answers = list(self.pool.map(self.probe, range(2)))  # waits here
        print('goes on')
        return answers

    def probe(self, place):
        return self.client.call(Trigger.Request())  # waits here

    def on_probe(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(Survey())


if __name__ == '__main__':
    main()
