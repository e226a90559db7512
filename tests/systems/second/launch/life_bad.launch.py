from launch import LaunchDescription
from launch_ros.actions import LifecycleNode, Node


def generate_launch_description():
    return LaunchDescription(
        [
            LifecycleNode(package='second', executable='lidar.py', name='lidar', namespace=''),
            Node(package='second', executable='scan_user.py'),
        ]
    )


# observed: scan_user
# CC708 launch/life_bad.launch.py: executable='lidar.py'
