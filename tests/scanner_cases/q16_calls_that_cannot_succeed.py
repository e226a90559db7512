"""Point 16: of two calls in a ``try`` for a ``TypeError`` the one that fits is made."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Behavior:
    def __init__(self, drone):
        drone.create_subscription(String, 'state', self.on_state, 10)

    def on_state(self, msg):
        pass


class Clock:
    def __init__(self):
        self.ticks = 0


class Module:
    def __init__(self, drone):
        try:
            super().__init__(drone)
        except TypeError:
            super().__init__()
        drone.create_timer(1.0, self.tick)

    def tick(self):
        pass


class Takeoff(Module, Behavior):
    pass


class Land(Module, Clock):
    pass


def begin(node, *, period):
    node.create_timer(period, tick)


def tick():
    pass


def main():
    rclpy.init()
    node = Node('drone')
    parts = [Takeoff(node), Land(node)]
    try:
        begin(node, 0.1)
    except (ValueError, TypeError):
        begin(node, period=0.2)
    rclpy.spin(node)
    return parts


if __name__ == '__main__':
    main()

# expect:
# unit drone: SingleThreadedExecutor x1 rclpy.spin, main
#   group drone_default EXCLUSIVE default
#   timer tick in drone_default every 1
#   timer tick_2 in drone_default (Module.tick) every 1
#   timer tick_3 in drone_default (tick) every 0.2
#   subscription on_state in drone_default key=state
