from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    names = ['coordinator', 'planner', 'mapper', 'sensors']
    return LaunchDescription(
        [
            *[Node(package='second', executable=name + '.py') for name in names],
            Node(
                package='second',
                executable='localizer.py',
                remappings=[('position', '/sensors/position')],
            ),
        ]
    )


# observed: coordinator
# nothing
