from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

VALUES = [FindPackageShare('systems'), '/config/rated_good.yaml']


def rated(space, **parameters):
    return Node(
        package='systems', executable='rated.py', namespace=space, parameters=[VALUES, parameters]
    )


def generate_launch_description():
    label = ParameterValue(LaunchConfiguration('label'), value_type=str)
    return LaunchDescription(
        [
            DeclareLaunchArgument('label', default_value='10'),
            rated('first'),
            rated('second', label=label, rate=LaunchConfiguration('rate', default='2.5')),
            rated('third', label='10', sizes=[3]),
        ]
    )


# nothing
