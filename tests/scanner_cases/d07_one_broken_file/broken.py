import rclpy

def broken(:
    pass
