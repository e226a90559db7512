"""P53: the executor is made and spun inside a class."""

import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor


class Robot:
    def __init__(self):
        self.node = rclpy.create_node('robot')
        self.node.create_timer(0.5, self.tick)
        self.executor = MultiThreadedExecutor(num_threads=2)
        self.executor.add_node(self.node)
        self.thread = threading.Thread(target=self._spin, daemon=True)
        self.thread.start()

    def _spin(self):
        self.executor.spin()

    def tick(self):
        pass


def main():
    rclpy.init()
    robot = Robot()
    robot.thread.join()


if __name__ == '__main__':
    main()

# expect:
# unit robot: MultiThreadedExecutor x2 spin in thread, main
#   group robot_default EXCLUSIVE default
#   timer tick in robot_default every 0.5
#   activity main main
#     blocks Thread.join on thread @28
#       ended by outside @16
