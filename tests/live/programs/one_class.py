"""One class under two names in executors of their own, and one of it lap by lap."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

LAPS = 2


class Counting(Node):
    """Counts its runs."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.runs = 0
        self.create_timer(0.005, self.count)

    def count(self) -> None:
        self.runs += 1


def main() -> None:
    rclpy.init()
    for _ in range(LAPS):
        lap = Counting('lap')
        executor = SingleThreadedExecutor()
        executor.add_node(lap)
        while lap.runs < 2:
            executor.spin_once()
        executor.shutdown()
        lap.destroy_node()
    left, right = Counting('left'), Counting('right')
    of_left, of_right = SingleThreadedExecutor(), SingleThreadedExecutor()
    of_left.add_node(left)
    of_right.add_node(right)
    while left.runs < 2 or right.runs < 2:
        of_left.spin_once(0.01)
        of_right.spin_once(0.01)
    print('laps', LAPS)
    rclpy.shutdown()


if __name__ == '__main__':
    main()
