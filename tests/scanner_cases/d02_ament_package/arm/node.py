import rclpy
from rclpy.executors import MultiThreadedExecutor

from . import settings
from .base import Base
from .helpers.watchdog import Watchdog


class Arm(Base):
    def __init__(self):
        super().__init__('arm')
        self.watchdog = Watchdog(self, settings.PERIOD)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(Arm())


def fast():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=settings.THREADS)
    executor.add_node(Arm())
    executor.spin()
