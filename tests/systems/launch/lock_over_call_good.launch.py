from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package='systems', executable='careful_keeper.py'),
            Node(package='systems', executable='witness.py'),
        ]
    )


# nothing
