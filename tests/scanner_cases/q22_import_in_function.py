"""Point 22: imports inside functions and under try."""

try:
    from rclpy.executors import MultiThreadedExecutor
except ImportError:
    MultiThreadedExecutor = None


def main():
    import rclpy
    from rclpy.node import Node

    rclpy.init()
    node = Node('a')
    node.create_timer(0.5, lambda: None)
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group a_default EXCLUSIVE default
#   timer lambda in a_default (main.<locals>.<lambda>) every 0.5
