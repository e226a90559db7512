from rclpy.callback_groups import ReentrantCallbackGroup

SHARED = ReentrantCallbackGroup()


def add_heartbeat(node, group=None):
    def beat():
        node.get_logger().info('beat')

    node.create_timer(1.0, beat, callback_group=group or SHARED)
