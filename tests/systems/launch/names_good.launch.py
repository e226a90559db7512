from launch import LaunchDescription
from launch.actions import GroupAction
from launch_ros.actions import Node, PushRosNamespace


def generate_launch_description():
    return LaunchDescription(
        [
            GroupAction(
                [
                    PushRosNamespace('robot'),
                    Node(
                        package='systems', executable='sink.py', remappings=[('request', 'plan')]
                    ),
                ]
            ),
            Node(package='systems', executable='asker.py', namespace='robot'),
            Node(package='systems', executable='asker.py', remappings=[('plan', '/robot/plan')]),
        ]
    )


# nothing
