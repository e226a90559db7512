"""Job relay: a subscription fills the box, a timer empties it."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

from helper_13_mailbox_mended import Box


class JobRelay(Node):
    """In by topic, out by the clock."""

    def __init__(self):
        super().__init__('job_relay')
        self.box = Box(size=4)
        self.out = self.create_publisher(String, 'done', 10)
        self.create_subscription(String, 'job', self.on_job, 20)
        self.create_timer(0.5, self.on_tick)

    def on_job(self, msg):
        self.box << msg.data

    def on_tick(self):
        for job in self.box:
            self.out.publish(String(data=job))


def main():
    rclpy.init()
    node = JobRelay()
    try:
        rclpy.spin(node)
    finally:
        node.destroy_node()


if __name__ == '__main__':
    main()
