from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    names = ['planner', 'mapper']
    nodes = [Node(package='second', executable=f'{name}.py', name=None) for name in names]
    return LaunchDescription(
        [
            Node(package='second', executable='coordinator.py', output='screen'),
            *nodes,
            Node(
                package='second',
                executable='localizer.py',
                remappings=[('position', '/coordinator/position')],
            ),
        ]
    )


# observed: coordinator
# CC109 programs/coordinator.py: answer = self.planner.call
