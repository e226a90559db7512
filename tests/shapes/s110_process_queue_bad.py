"""A callback takes from the queue of a process that waits for what it puts next."""

import multiprocessing

import rclpy
from rclpy.node import Node


def work(requests, results):
    while True:
        results.put(requests.get())


class Planner(Node):
    def __init__(self, requests, results):
        super().__init__('planner')
        self.requests, self.results = requests, results
        self.create_timer(0.3, self.plan)

    def plan(self):
        self.results.get()  # waits here
        self.requests.put('plan')
        print('goes on')


def main():
    context = multiprocessing.get_context('fork')
    requests, results = context.Queue(), context.Queue()
    context.Process(target=work, args=(requests, results), daemon=True).start()
    rclpy.init()
    rclpy.spin(Planner(requests, results))


if __name__ == '__main__':
    main()
