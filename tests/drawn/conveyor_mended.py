import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node
from std_msgs.msg import Float64

from h07_helper_remote_params import RemoteParams


class SiteConfig(Node):
    """Holds the settings common to the whole line."""

    def __init__(self):
        super().__init__('site_config')
        self.declare_parameter('belt_speed', 0.8)
        self.declare_parameter('belt_length', 12.0)


class Conveyor(LifecycleNode):

    def __init__(self):
        super().__init__('conveyor')
        self._site = RemoteParams(
            self, 'site_config', callback_group=MutuallyExclusiveCallbackGroup())
        self._settings = {}
        self._position = 0.0
        self._timer = None
        self._pub = self.create_lifecycle_publisher(Float64, 'belt_position', 10)

    def on_configure(self, state):
        self.get_logger().info('configuring')
        if not self._site.available(2.0):
            return TransitionCallbackReturn.FAILURE
        self._settings = self._site.fetch(['belt_speed', 'belt_length'])
        self._timer = self.create_timer(
            0.5, self.advance, callback_group=MutuallyExclusiveCallbackGroup())
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state):
        self.get_logger().info('belt running')
        return super().on_activate(state)

    def on_cleanup(self, state):
        self.destroy_timer(self._timer)
        return TransitionCallbackReturn.SUCCESS

    def advance(self):
        self._position += 0.5 * self._settings['belt_speed']
        self._position %= self._settings['belt_length']
        self._pub.publish(Float64(data=self._position))


class LineManager(Node):
    """Brings the conveyor up step by step."""

    STEPS = (Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE)

    def __init__(self):
        super().__init__('line_manager')
        self._steps = list(self.STEPS)
        self._client = self.create_client(ChangeState, 'conveyor/change_state')
        self.create_subscription(Float64, 'belt_position', self.on_position, 10)
        self._timer = self.create_timer(0.5, self.begin)

    def begin(self):
        if self._client.service_is_ready():
            self._timer.cancel()
            self.next_step()

    def next_step(self):
        request = ChangeState.Request()
        request.transition.id = self._steps.pop(0)
        self._client.call_async(request).add_done_callback(self.on_changed)

    def on_changed(self, future):
        self.get_logger().info('transition ok: %s' % future.result().success)
        if self._steps:
            self.next_step()

    def on_position(self, msg):
        self.get_logger().info('belt at %.1f' % msg.data)


def main():
    rclpy.init()
    nodes = [SiteConfig(), Conveyor(), LineManager()]
    executor = MultiThreadedExecutor(num_threads=4)
    for node in nodes:
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown(timeout_sec=1.0)
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
