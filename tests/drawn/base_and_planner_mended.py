"""Base driver and local planner started as one composed application."""
import math
import threading

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node


class BaseDriver(Node):
    def __init__(self):
        super().__init__('base_driver')
        self.command = Twist()
        self.x = 0.0
        self.yaw = 0.0
        self.odom_pub = self.create_publisher(Odometry, 'odom', 10)
        self.create_subscription(Twist, 'cmd_vel', self.on_command, 10)
        self.create_timer(0.05, self.on_control)

    def on_command(self, msg):
        self.command = msg

    def on_control(self):
        self.yaw += self.command.angular.z * 0.05
        self.x += self.command.linear.x * math.cos(self.yaw) * 0.05
        odom = Odometry()
        odom.header.stamp = self.get_clock().now().to_msg()
        odom.pose.pose.position.x = self.x
        self.odom_pub.publish(odom)


class LocalPlanner(Node):
    def __init__(self):
        super().__init__('local_planner')
        self.goal_x = 2.0
        self.received = 0
        self.cmd_pub = self.create_publisher(Twist, 'cmd_vel', 10)
        self.create_subscription(Odometry, 'odom', self.on_odom, 10)
        self.create_timer(1.0, self.on_report)

    def on_odom(self, msg):
        self.received += 1
        cmd = Twist()
        error = self.goal_x - msg.pose.pose.position.x
        cmd.linear.x = max(-0.5, min(0.5, error))
        self.cmd_pub.publish(cmd)

    def on_report(self):
        self.get_logger().info(f'{self.received} odometry messages so far')


def spin_quietly(node):
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        executor.spin()
    except ExternalShutdownException:
        pass


def main():
    rclpy.init()
    driver = BaseDriver()
    planner = LocalPlanner()
    driver_thread = threading.Thread(target=spin_quietly, args=(driver,))
    driver_thread.start()
    try:
        spin_quietly(planner)
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
    driver_thread.join()
    planner.destroy_node()
    driver.destroy_node()


if __name__ == '__main__':
    main()
