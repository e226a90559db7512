"""E38: who ends a wait is cancelled, never started, destroyed, or runs once, perhaps too early."""

import threading

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Feeder(Node):
    def __init__(self):
        super().__init__('feeder')
        self.fed, self.oiled, self.washed = (threading.Event() for _ in range(3))
        self.warm = threading.Condition()
        group = ReentrantCallbackGroup()
        self.cancelled = self.create_timer(1.0, self.feed, group)
        self.asleep = self.create_timer(1.0, self.oil, group, autostart=False)
        self.started = self.create_timer(1.0, self.wash, group, autostart=False)
        self.once = self.create_timer(1.0, self.heat, group)
        self.create_timer(2.0, self.work, group)

    def feed(self):
        self.fed.set()

    def oil(self):
        self.oiled.set()

    def wash(self):
        self.washed.set()

    def heat(self):
        self.once.cancel()
        with self.warm:
            self.warm.notify()

    def work(self):
        self.started.reset()
        self.washed.wait()
        self.oiled.wait()
        self.cancelled.cancel()
        self.fed.wait()
        with self.warm:
            self.warm.wait()


class Starter(Node):
    def __init__(self):
        super().__init__('starter')
        self.ready = threading.Condition()
        self.is_ready = False
        self.again = self.create_timer(1.0, self.prepare)
        self.create_timer(2.0, self.start, ReentrantCallbackGroup())

    def prepare(self):
        self.again.cancel()
        with self.ready:
            self.is_ready = True
            self.ready.notify()

    def start(self):
        with self.ready:
            while not self.is_ready:
                self.ready.wait()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Feeder())
    executor.add_node(Starter())
    executor.spin()


if __name__ == '__main__':
    main()


# expect:
# unit feeder_and_starter: MultiThreadedExecutor x4 spin, main
#   nodes feeder, starter
#   group group REENTRANT
#   group starter_default EXCLUSIVE default
#   group start_group REENTRANT
#   timer feed in group every 1 node=feeder
#   timer oil in group every 1 node=feeder
#   timer wash in group every 1 node=feeder
#   timer heat in group every 1 node=feeder one_shot
#     locks warm @34
#   timer work in group every 2 node=feeder
#     blocks Event.wait on wash through washed @39
#       ended by wash @30
#     blocks Event.wait on oil through oiled @40
#       ended by oil conditional @27
#       ended by ?
#     blocks Event.wait on feed through fed @42
#       ended by feed conditional @24
#       ended by ?
#     blocks Condition.wait on heat through warm each forgets @44
#       ended by heat @35
#     locks warm @43
#   timer prepare in starter_default every 1 node=starter one_shot
#     writes Starter.is_ready under ready @58
#     locks ready @57
#   timer start in start_group every 2 node=starter
#     blocks Condition.wait on prepare through ready conditional @64
#       ended by prepare @59
#     reads Starter.is_ready under ready @63
#     locks ready @62
