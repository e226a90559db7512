from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(
                package='systems',
                executable='camera.py',
                parameters=[{'frame_rate': 10.0, 'use_sim_time': False}],
            ),
            Node(
                package='systems',
                executable='good_viewer.py',
                parameters=[{'use_sim_time': True}],  # it has nothing that waits for time
                remappings=[('image', '/image')],
            ),
        ]
    )


# nothing
