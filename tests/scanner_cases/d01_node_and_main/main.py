import rclpy
from node import A
from rclpy.executors import MultiThreadedExecutor


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()
