from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package='systems', executable='keeper.py'),
            Node(package='systems', executable='witness.py'),
        ]
    )


# CC109 programs/keeper.py: self.confirm.call
