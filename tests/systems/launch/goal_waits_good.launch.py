from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package='systems', executable='good_boss.py'),
            Node(package='systems', executable='mover.py'),
        ]
    )


# nothing
