from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    config = f'{get_package_share_directory("second")}/config/store_3.yaml'
    readers = []
    for number in range(2):
        readers.append(Node(package='second', executable='reader.py', name=f'reader_{number}'))
    return LaunchDescription(
        [
            *readers,
            Node(package='second', executable='store.py', parameters=[config]),
            Node(package='second', executable='loader.py'),
        ]
    )


# observed: reader
# nothing
