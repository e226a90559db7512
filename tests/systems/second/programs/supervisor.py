"""Configures and cleans up the arm by turns, and gives grants."""

import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Supervisor(Node):
    def __init__(self):
        super().__init__('supervisor')
        answers = MutuallyExclusiveCallbackGroup()
        grants = MutuallyExclusiveCallbackGroup()
        if not self.declare_parameter('grants_beside', False).value:
            grants = self.default_callback_group
        self.change = self.create_client(ChangeState, '/arm/change_state', callback_group=answers)
        self.create_service(Trigger, '~/grant', self.on_grant, callback_group=grants)
        self.create_timer(0.2, self.supervise)
        self.is_up = False

    def supervise(self):
        request = ChangeState.Request()
        request.transition.id = (
            Transition.TRANSITION_CLEANUP if self.is_up else Transition.TRANSITION_CONFIGURE
        )
        print('asks', flush=True)
        self.change.call(request)
        self.is_up = not self.is_up
        print('goes on', flush=True)

    def on_grant(self, request, response):
        response.success = True
        return response


def main():
    rclpy.init()
    node = Supervisor()
    node.change.wait_for_service()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
