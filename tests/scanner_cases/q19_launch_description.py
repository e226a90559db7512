"""Point 19: a node action of a launch file is no node."""
# live: no, needs launch

import rclpy  # noqa
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package='a', executable='b', name='c')])

# expect:
# nothing
