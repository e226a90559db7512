"""EffectLog: the result of an unknown future is no wait where the text shows that it is done."""
# live: no, the module tools is not there
import asyncio

import rclpy
from rclpy.node import Node
from tools import make_jobs, start_job


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.jobs = make_jobs()
        self.create_timer(1.0, self.collect)
        self.create_timer(1.0, self.collect_if_sure)
        self.create_timer(1.0, self.fetch)

    def collect(self):
        for job in self.jobs:
            if job.done() and asyncio:
                job.result()

    def collect_if_sure(self):
        for job in self.jobs:
            if not job.done():
                continue
            job.exception()
            job = start_job()
            job.result()

    async def fetch(self):
        one, other = start_job(), start_job()
        await one
        one.result()
        if one.done() or other.done():
            other.result()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer collect in a_default every 1
#     reads A.jobs @19
#   timer collect_if_sure in a_default every 1
#     blocks unknown wait on ? conditional @29
#       ended by ?
#     reads A.jobs @24
#   timer fetch in a_default every 1 coroutine
#     blocks await on ? @33
#       ended by ?
#     blocks unknown wait on ? conditional @36
#       ended by ?
