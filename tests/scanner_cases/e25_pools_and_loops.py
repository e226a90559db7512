"""EffectLog: tasks of pools and of a loop of asyncio, and all the ways to wait for them."""

import asyncio
import concurrent.futures
import threading
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.pool = ThreadPoolExecutor()
        self.loop = asyncio.new_event_loop()
        threading.Thread(target=self.loop.run_forever).start()
        self.heard = threading.Event()
        self.create_subscription(String, 'in', self.on_in, 10)
        self.create_timer(1.0, self.leave)
        self.create_timer(1.0, self.gather)
        self.create_timer(1.0, self.bridge)

    def on_in(self, msg):
        self.heard.set()

    def task(self):
        self.heard.wait()

    async def coroutine(self):
        await asyncio.to_thread(self.task)

    def leave(self):
        with ThreadPoolExecutor() as pool:
            pool.submit(self.task)

    def gather(self):
        futures = [self.pool.submit(self.task)]
        concurrent.futures.wait(futures, timeout=1.0)
        for done in concurrent.futures.as_completed(futures):
            done.result()
        list(self.pool.map(self.task, []))

    def bridge(self):
        asyncio.run_coroutine_threadsafe(self.coroutine(), self.loop).result()
        asyncio.run(self.coroutine())


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer leave in a_default every 1
#     blocks Executor.shutdown on Future @35
#       ended by task @36
#   timer gather in a_default every 1
#     blocks futures.wait on Future through Future#2 1.0 s @40
#       ended by task_2 @39
#     blocks futures.as_completed on Future through Future#2 @41
#       ended by task_2 @39
#     blocks Executor.map on map @43
#       ended by task_3 @43
#   timer bridge in a_default every 1
#     blocks Future.result on Future through Future#3 @46
#       ended by coroutine @46
#     blocks asyncio await on Future through Future#4 @47>32
#       ended by task_5 @32
#     reads A.loop @46
#   subscription on_in in a_default key=in
#   activity thread run_forever loops
#   activity pool task (A.task) started by leave @36 count=?
#     blocks Event.wait on on_in through heard @29
#       ended by on_in @26
#   activity pool task_2 (A.task) started by gather @39 count=?
#     blocks Event.wait on on_in through heard @29
#       ended by on_in @26
#   activity pool task_3 (A.task) started by gather after 2 @43 count=?
#     blocks Event.wait on on_in through heard @29
#       ended by on_in @26
#   activity thread coroutine (A.coroutine) started by bridge @46 count=?
#     blocks await on Future through Future#5 @32
#       ended by task_4 @32
#   activity pool task_4 (A.task) started by coroutine @32 count=?
#     blocks Event.wait on on_in through heard @29
#       ended by on_in @26
#   activity pool task_5 (A.task) started by bridge after 1 @32 count=?
#     blocks Event.wait on on_in through heard @29
#       ended by on_in @26
# warning nobody-spins @18
