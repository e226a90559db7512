"""QoS event callbacks are waitables in the group of their entity."""
# live: no, the probe leaves event handlers out

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.group = ReentrantCallbackGroup()
        self.create_subscription(
            String,
            'in',
            self.on_in,
            10,
            callback_group=self.group,
            event_callbacks=SubscriptionEventCallbacks(deadline=self.on_missed),
        )
        self.create_publisher(
            String, 'out', 10, event_callbacks=PublisherEventCallbacks(liveliness=self.on_lost)
        )

    def on_in(self, msg):
        pass

    def on_missed(self, event):
        pass

    def on_lost(self, event):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group group REENTRANT
#   group a_default EXCLUSIVE default
#   subscription on_in in group key=in
#   qos_event on_missed in group key=in
#   qos_event on_lost in a_default key=out
