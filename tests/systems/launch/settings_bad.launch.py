from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(
                package='systems',
                executable='camera.py',
                parameters=[{'frame_rat': 10.0, 'use_sim_time': True}],
            ),
            Node(package='systems', executable='viewer.py', remappings=[('imags', 'image')]),
        ]
    )


# CC706 launch/settings_bad.launch.py: Node(
# CC706 launch/settings_bad.launch.py: viewer.py
# CC703 programs/viewer.py: self.on_image, 10
# CC704 launch/settings_bad.launch.py: Node(
