import rclpy
from robot import A


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()
