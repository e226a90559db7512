"""The version of the tool; a leaf, so that nothing has to import the package for it."""

__version__ = '0.1.0'
