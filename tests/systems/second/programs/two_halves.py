"""Two nodes on executors of their own: the front waits for an event that the back sets."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Front(Node):
    def __init__(self, arrived, apart):
        super().__init__('front')
        self.arrived = arrived
        group = MutuallyExclusiveCallbackGroup() if apart else None
        self.create_service(Trigger, 'level', self.on_level, callback_group=group)
        self.create_timer(0.2, self.step)

    def step(self):
        print('asks', flush=True)
        self.arrived.wait()
        self.arrived.clear()
        print('goes on', flush=True)

    def on_level(self, request, response):
        response.success = True
        return response


class Back(Node):
    def __init__(self, arrived):
        super().__init__('back')
        self.arrived = arrived
        answers = MutuallyExclusiveCallbackGroup()
        self.check = self.create_client(Trigger, 'check', callback_group=answers)
        self.create_timer(0.2, self.look)

    def look(self):
        self.check.call(Trigger.Request())
        self.arrived.set()


def main():
    rclpy.init()
    arrived = threading.Event()
    parameters = Node('two_halves_parameters')
    apart = parameters.declare_parameter('apart', False).value
    front, back = Front(arrived, apart), Back(arrived)
    back.check.wait_for_service()
    first = MultiThreadedExecutor(num_threads=2) if apart else SingleThreadedExecutor()
    first.add_node(front)
    second = MultiThreadedExecutor(num_threads=2)
    second.add_node(back)
    threading.Thread(target=second.spin, daemon=True).start()
    first.spin()


if __name__ == '__main__':
    main()
