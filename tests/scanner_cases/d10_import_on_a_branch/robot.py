import rclpy
from rclpy.node import Node


class Nothing:
    def open(self):
        pass


class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        if self.declare_parameter('camera', False).value:
            from camera import Camera

            self.eye = Camera(self)
        else:
            self.eye = Nothing()
        self.eye.open()


def main():
    rclpy.init()
    rclpy.spin(Robot())


if __name__ == '__main__':
    main()
