from launch import LaunchDescription
from launch_ros.actions import LifecycleNode, Node


def generate_launch_description():
    return LaunchDescription(
        [
            LifecycleNode(package='second', executable='lidar.py', name='lidar', namespace=''),
            Node(package='second', executable='scan_user.py'),
            Node(package='second', executable='manager.py'),
        ]
    )


# observed: scan_user
# nothing
