from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package='systems', executable='boss.py'),
            Node(package='systems', executable='mover.py'),
        ]
    )


# CC109 programs/boss.py: self.move.send_goal
