"""Name and version of the tool; a leaf, so that nothing has to import the package for them."""

PROGRAM = 'ros2cc-extract'
__version__ = '0.1.0'
