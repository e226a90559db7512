"""A transition waits for an event that a subscription of the default group sets."""

import threading

import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.executors import MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node
from std_msgs.msg import String


class Radar(LifecycleNode):
    def __init__(self):
        super().__init__('radar')
        self.warm = threading.Event()
        self.create_subscription(String, 'warm', self.on_warm, 10)

    def on_warm(self, msg):
        self.warm.set()

    def on_configure(self, state):
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state):
        self.warm.clear()
        self.warm.wait()  # waits here
        print('goes on')
        return TransitionCallbackReturn.FAILURE


class Manager(Node):
    def __init__(self):
        super().__init__('manager')
        self.step = Transition.TRANSITION_CONFIGURE
        self.heat = self.create_publisher(String, 'warm', 10)
        self.change = self.create_client(ChangeState, 'radar/change_state')
        self.create_timer(0.5, self.warm_up)
        self.create_timer(0.6, self.activate)

    def warm_up(self):
        self.heat.publish(String())

    def activate(self):
        transition = Transition(id=self.step)
        self.change.call_async(ChangeState.Request(transition=transition))
        self.step = Transition.TRANSITION_ACTIVATE


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Radar())
    executor.add_node(Manager())
    executor.spin()


if __name__ == '__main__':
    main()
