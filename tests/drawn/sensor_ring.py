"""Ultrasonic ring: one job per sensor, created in a loop."""
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import Range


class Ring(Node):
    SENSORS = {'front': 0.02, 'left': 0.02, 'right': 0.02, 'rear': 0.7}

    def __init__(self):
        super().__init__('ultrasonic_ring')
        self.counts = dict.fromkeys(self.SENSORS, 0)
        for name, echo in self.SENSORS.items():
            publisher = self.create_publisher(Range, f'range/{name}', 5)
            group = MutuallyExclusiveCallbackGroup()
            self.create_timer(
                0.2, self.make_job(name, echo, publisher), callback_group=group)
        self.create_timer(1.0, self.on_report)

    def make_job(self, name, echo, publisher):
        def job():
            time.sleep(echo)
            publisher.publish(Range(range=1.0 + 0.1 * self.counts[name]))
            self.counts[name] += 1
        return job

    def on_report(self):
        text = ', '.join(f'{k} {v}' for k, v in self.counts.items())
        self.get_logger().info(text)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=len(Ring.SENSORS) + 1)
    executor.add_node(Ring())
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    rclpy.try_shutdown()


if __name__ == '__main__':
    main()
