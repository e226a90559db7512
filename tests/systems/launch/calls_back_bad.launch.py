from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package='systems', executable='arm.py'),
            Node(package='systems', executable='planner.py'),
        ]
    )


# CC109 programs/arm.py: self.plan.call
