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
            Node(package='systems', executable='asker.py'),
            Node(package='systems', executable='asker.py', remappings=[('plan', '/robot/plan2')]),
        ]
    )


# CC705 launch/names_bad.launch.py: executable='asker.py', remappings
# CC701 programs/asker.py: self.plan = self.create_client
