from setuptools import setup

setup(
    name='arm',
    packages=['arm'],
    entry_points={
        'console_scripts': [
            'arm_node = arm.node:main',
            'arm_fast = arm.node:fast',
        ],
    },
)
