"""Two nodes on executors of their own share a lock; nobody is asked while it is held."""

import threading

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Left(Node):
    def __init__(self, lock):
        super().__init__('left')
        self.lock = lock
        self.moves = 0
        group = ReentrantCallbackGroup()
        self.judge = self.create_client(Trigger, 'judge', callback_group=group)
        self.create_timer(0.2, self.move)

    def move(self):
        print('asks', flush=True)
        with self.lock:
            self.moves += 1
        self.judge.call(Trigger.Request())
        with self.lock:
            self.moves -= 1
        print('goes on', flush=True)


class Right(Node):
    def __init__(self, lock):
        super().__init__('right')
        self.lock = lock
        self.create_service(Trigger, 'look', self.on_look)

    def on_look(self, request, response):
        with self.lock:
            response.success = True
        return response


def main():
    rclpy.init()
    lock = threading.Lock()
    left, right = Left(lock), Right(lock)
    left.judge.wait_for_service()
    executors = [MultiThreadedExecutor(num_threads=3), SingleThreadedExecutor()]
    for executor, node in zip(executors, (left, right), strict=True):
        executor.add_node(node)
    threading.Thread(target=executors[1].spin, daemon=True).start()
    executors[0].spin()


if __name__ == '__main__':
    main()
