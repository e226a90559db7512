"""An arm with a life cycle: it asks for a grant before it is configured."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_srvs.srv import Trigger


class Arm(LifecycleNode):
    def __init__(self):
        super().__init__('arm')
        self.grant = self.create_client(
            Trigger, '/supervisor/grant', callback_group=MutuallyExclusiveCallbackGroup()
        )

    def on_configure(self, state):
        self.grant.wait_for_service()
        self.grant.call(Trigger.Request())
        return TransitionCallbackReturn.SUCCESS


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()
