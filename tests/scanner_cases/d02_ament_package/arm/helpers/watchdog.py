from rclpy.node import Node


class Watchdog:
    def __init__(self, node: Node, period):
        self.node = node
        node.create_timer(period, self.check, callback_group=node.group)

    def check(self):
        self.node.get_logger().info('alive')
