"""Nodes with every option that adds or removes an entity that rclpy makes by itself."""

import contextlib

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import String


class Arm(Node):
    def __init__(self) -> None:
        super().__init__('arm')
        group = ReentrantCallbackGroup()
        self.create_publisher(String, 'pose', 10, callback_group=group)
        self.create_subscription(String, 'goal', self.on_goal, 10, callback_group=group)
        self.create_rate(5)
        self.create_publisher(
            String,
            'state',
            10,
            event_callbacks=PublisherEventCallbacks(use_default_callbacks=False),
        )
        self.create_subscription(
            String,
            'stop',
            self.on_goal,
            10,
            event_callbacks=SubscriptionEventCallbacks(incompatible_qos=self.on_other_qos),
        )

    def on_goal(self, message: String) -> None:
        pass

    def on_other_qos(self, event: object) -> None:
        pass


class Lamp(LifecycleNode):
    def __init__(self) -> None:
        super().__init__('lamp', enable_logger_service=True)
        self.create_lifecycle_publisher(String, 'light', 10)


class Clockwork(Node):
    def __init__(self) -> None:
        simulated = Parameter('use_sim_time', value=True)
        super().__init__(
            'clockwork', start_parameter_services=False, parameter_overrides=[simulated]
        )


def main() -> None:
    rclpy.init()
    executor = SingleThreadedExecutor()
    for node in (
        Arm(),
        Lamp(),
        Clockwork(),
        LifecycleNode('door', start_parameter_services=False),
    ):
        executor.add_node(node)
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()


if __name__ == '__main__':
    main()
