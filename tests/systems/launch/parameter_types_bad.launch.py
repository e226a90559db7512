from launch import LaunchDescription
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

VALUES = [FindPackageShare('systems'), '/config/rated_bad.yaml']
SPACES = ['', 'first', 'second', 'third', 'fourth', 'fifth']


def rated(space):
    return Node(package='systems', executable='rated.py', namespace=space, parameters=[VALUES])


def generate_launch_description():
    return LaunchDescription([rated(space) for space in SPACES])


# CC709 config/rated_bad.yaml: rate: "fast"
# CC709 config/rated_bad.yaml: rate: 10
# CC709 config/rated_bad.yaml: label: on
# CC709 config/rated_bad.yaml: sizes: [1.0, 2.0]
# CC709 config/rated_bad.yaml: gain: "0.5"
# CC709 config/rated_bad.yaml: count: 1e3
