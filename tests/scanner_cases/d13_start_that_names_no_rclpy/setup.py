from setuptools import setup

setup(entry_points={'console_scripts': ['program = program:main']})
