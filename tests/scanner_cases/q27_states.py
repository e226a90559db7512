"""Point 27: states that give each other on: what any of them makes is made by the callback."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Idle:
    def loop(self, node):
        return Search()


class Search:
    def __init__(self):
        self.timer = None

    def loop(self, node):
        if self.timer is None:
            self.timer = node.create_timer(0.5, self.plan)
            return self
        return Pick(node)

    def plan(self):
        pass


class Pick:
    def __init__(self, node):
        self.node = node
        self.found = None

    def loop(self, node):
        if self.found is None:
            self.found = self.node.create_subscription(String, 'found', self.on_found, 10)
        node.state = Done()
        return node.state

    def on_found(self, msg):
        pass


class Done:
    def loop(self, node):
        return self


class Machine(Node):
    def __init__(self):
        super().__init__('machine')
        self.state = Idle()
        self.step = self.first
        self.create_timer(0.1, self.update)
        self.create_timer(0.1, self.go_on)

    def update(self):
        self.state = self.state.loop(self)

    def go_on(self):
        self.step()

    def first(self):
        self.step = self.second

    def second(self):
        self.step = lambda: self.last('last')

    def last(self, topic):
        self.done = self.create_subscription(String, topic, self.on_done, 10)
        self.step = self.idle

    def idle(self):
        pass

    def on_done(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(Machine())


if __name__ == '__main__':
    main()

# expect:
# unit machine: SingleThreadedExecutor x1 rclpy.spin, main
#   group machine_default EXCLUSIVE default
#   timer update in machine_default every 0.1
#     reads Machine.state @56
#     reads Search.timer @56>18
#     reads Machine.state @56>36
#     writes Search.timer rests under Search.timer (flag) @56>19
#     writes Machine.state @56>35
#     writes Machine.state rests later @56
#     changes timer @56>19
#     changes subscription @56>34
#   timer go_on in machine_default every 0.1
#     reads Machine.step @59
#     writes Machine.done @59>65>68
#     writes Machine.step @59>65>69
#     writes Machine.step @59>65
#     writes Machine.step @59>62
#     changes subscription @59>65>68
#   timer plan in machine_default every 0.5 conditional count=? when=callback
#   subscription on_found in machine_default key=found conditional count=? when=callback
#   subscription on_done in machine_default key=last conditional count=? when=callback
#   ? plan count
#   ? on_found count
#   ? on_done count
