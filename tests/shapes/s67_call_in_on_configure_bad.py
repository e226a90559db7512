"""A transition waits for an answer in the group of the node's own services."""

import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.executors import MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node
from std_srvs.srv import Trigger


class Camera(LifecycleNode):
    def __init__(self):
        super().__init__('camera')
        self.client = self.create_client(Trigger, 'power')

    def on_configure(self, state):
        self.client.call(Trigger.Request())  # waits here
        print('goes on')
        return TransitionCallbackReturn.FAILURE


class Manager(Node):
    def __init__(self):
        super().__init__('manager')
        self.create_service(Trigger, 'power', self.on_power)
        self.change = self.create_client(ChangeState, 'camera/change_state')
        self.create_timer(0.5, self.configure)

    def on_power(self, request, response):
        return response

    def configure(self):
        transition = Transition(id=Transition.TRANSITION_CONFIGURE)
        self.change.call_async(ChangeState.Request(transition=transition))


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Camera())
    executor.add_node(Manager())
    executor.spin()


if __name__ == '__main__':
    main()
