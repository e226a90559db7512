from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def nodes(context):
    beside = LaunchConfiguration('beside').perform(context) == 'true'
    return [
        Node(package='second', executable='mission.py', parameters=[{'beside': beside}]),
        Node(package='second', executable='driver.py'),
        Node(package='second', executable='map_keeper.py'),
    ]


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument('beside', default_value='true'),
            OpaqueFunction(function=nodes),
        ]
    )


# observed: mission
# nothing
