"""Brings a node with a life cycle up: configures and activates it."""

import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.node import Node


class Manager(Node):
    def __init__(self):
        super().__init__('manager')
        self.change = self.create_client(ChangeState, '/lidar/change_state')

    def bring_up(self):
        self.change.wait_for_service()
        for number in (Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE):
            request = ChangeState.Request()
            request.transition.id = number
            future = self.change.call_async(request)
            rclpy.spin_until_future_complete(self, future)


def main():
    rclpy.init()
    node = Manager()
    node.bring_up()
    rclpy.spin(node)


if __name__ == '__main__':
    main()
