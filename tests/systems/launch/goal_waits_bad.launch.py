from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package='systems', executable='boss.py'),
            Node(package='systems', executable='mover.py'),
        ]
    )


# nothing: several goals may run at a time, and it is left undecided
