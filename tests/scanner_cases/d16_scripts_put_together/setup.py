import os

from setuptools import find_packages, setup

package_name = 'arm'
nodes = ['node', 'other']

setup(
    name=package_name,
    packages=find_packages(),
    entry_points={
        'console_scripts': [
            'arm_fast = ' + package_name + '.node:fast',
            *(f'arm_{name} = {package_name}.{name}:ros_main' for name in nodes),
            'arm_more = %s:ros_main' % os.environ['MODULE'],
        ],
    },
)
