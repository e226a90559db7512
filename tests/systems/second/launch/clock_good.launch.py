from launch import LaunchDescription
from launch.actions import GroupAction
from launch_ros.actions import Node, SetParameter


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package='second', executable='simulator.py'),
            GroupAction(
                [
                    SetParameter('use_sim_time', True),
                    Node(package='second', executable='ticker.py'),
                ]
            ),
            Node(package='second', executable='ticker.py', name='wall_ticker'),
        ]
    )


# observed: ticker
# nothing
