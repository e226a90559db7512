from launch import LaunchDescription
from launch.actions import GroupAction
from launch_ros.actions import Node, PushRosNamespace


def generate_launch_description():
    publisher = Node(
        package='second', executable='map_publisher.py', parameters=[{'latched': True}]
    )
    viewer = Node(package='second', executable='light_viewer.py')
    return LaunchDescription([GroupAction([PushRosNamespace('left'), publisher, viewer])])


# observed: light_viewer
# nothing
