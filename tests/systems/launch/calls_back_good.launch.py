from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    beside = LaunchConfiguration('beside')
    return LaunchDescription(
        [
            DeclareLaunchArgument('beside', default_value='true'),
            Node(package='systems', executable='arm.py', parameters=[{'beside': beside}]),
            Node(package='systems', executable='planner.py'),
        ]
    )


# nothing
