"""P60: another executor takes the place of one that cannot be imported."""
# live: no, depends on the release

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

try:
    from rclpy.experimental.events_executor import EventsExecutor
except ImportError:
    EventsExecutor = None


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = EventsExecutor() if EventsExecutor is not None else SingleThreadedExecutor()
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: EventsExecutor x1 spin alternative@27.0 import caught, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
# unit a: SingleThreadedExecutor x1 spin alternative@27.1, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
