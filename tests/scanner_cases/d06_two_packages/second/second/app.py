import rclpy
from first.lib import add_heartbeat
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup


def main():
    rclpy.init()
    node = rclpy.create_node('second')
    add_heartbeat(node)
    add_heartbeat(node, MutuallyExclusiveCallbackGroup())
    rclpy.spin(node)


if __name__ == '__main__':
    main()
