"""E41: tasks of a pool of one thread, coroutines of the loop that spins, children of a fork."""

import asyncio
import os
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.node import Node


class Stitcher(Node):
    def __init__(self, loop):
        super().__init__('stitcher')
        self.loop = loop
        self.one = ThreadPoolExecutor(max_workers=1)
        self.two = ThreadPoolExecutor(max_workers=2)
        self.create_timer(1.0, self.stitch)
        self.create_timer(1.0, self.send)
        self.create_timer(1.0, self.archive)

    def stitch(self):
        self.one.submit(self.join_on_one)
        self.two.submit(self.join_on_two)

    def join_on_one(self):
        self.one.submit(self.load).result()

    def join_on_two(self):
        self.two.submit(self.load).result()

    def load(self):
        return 'image'

    def send(self):
        asyncio.run_coroutine_threadsafe(self.transmit(), self.loop).result()

    async def transmit(self):
        await asyncio.sleep(0.01)

    def archive(self):
        child = os.fork()
        if child == 0:
            os._exit(0)
        os.waitpid(child, 0)


async def serve():
    node = Stitcher(asyncio.get_running_loop())
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0)
        await asyncio.sleep(0.01)


def main():
    rclpy.init()
    asyncio.run(serve())


if __name__ == '__main__':
    main()


# expect:
# unit stitcher: SingleThreadedExecutor x1 rclpy.spin_once, main
#   group stitcher_default EXCLUSIVE default
#   timer stitch in stitcher_default every 1
#   timer send in stitcher_default every 1
#     blocks Future.result on Future @35
#       ended by transmit @35
#     reads Stitcher.loop @35
#   timer archive in stitcher_default every 1
#     blocks os.waitpid @44
#       ended by ?
#   activity pool join_on_one (Stitcher.join_on_one) started by stitch @22 count=?
#     blocks Future.result on Future through Future#2 @26
#       ended by load @26
#   activity pool load (Stitcher.load) started by join_on_one @26 count=?
#   activity pool join_on_two (Stitcher.join_on_two) started by stitch @23 count=?
#     blocks Future.result on Future through Future#3 @29
#       ended by load_2 conditional @29
#       ended by ?
#   activity pool load_2 (Stitcher.load) started by join_on_two @29 count=?
#   activity thread transmit (Stitcher.transmit) started by send @35 count=?
#     blocks asyncio.sleep 0.01 s @38
