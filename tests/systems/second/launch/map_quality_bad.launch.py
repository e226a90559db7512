from launch import LaunchDescription
from launch.actions import GroupAction
from launch_ros.actions import Node, PushRosNamespace


def generate_launch_description():
    publisher = Node(
        package='second', executable='map_publisher.py', parameters=[{'latched': False}]
    )
    viewer = Node(package='second', executable='map_viewer.py')
    return LaunchDescription([GroupAction([PushRosNamespace('left'), publisher, viewer])])


# observed: map_viewer
# CC703 programs/map_viewer.py: create_subscription
