"""Point 22: from rclpy import spin, create_node."""

from rclpy import create_node, init, spin


def tick():
    pass


def main():
    init()
    node = create_node('a')
    node.create_timer(0.5, tick)
    spin(node)


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
