"""Builds what is native: the checker, the journal of the hook, and what enters a process."""

import os

from setuptools import Extension, setup

try:
    from pybind11 import get_include
except ImportError:
    # Built without isolation, as colcon does: the headers of pybind11-dev stand where a compiler
    # looks; without them the checker is pure Python.
    INCLUDES = []
else:
    INCLUDES = [get_include()]

# What is native: 'required' where its absence must not pass, as in a release; 'none' leaves it
# out. Otherwise the package also works without a compiler: the checker, or the hook, then is pure
# Python, and a process is entered by Python 3.14 alone; what that costs is in docs/install.md.
NATIVE = os.environ.get('ROS2CC_NATIVE_BUILD', 'optional')
if NATIVE not in ('optional', 'required', 'none'):
    raise SystemExit(f'ROS2CC_NATIVE_BUILD is optional, required or none, and not {NATIVE}')
IS_OPTIONAL = NATIVE == 'optional'

setup(
    # colcon evaluates what it reads here as literals; from pyproject.toml this comes as none.
    python_requires='>=3.10',
    # In pyproject.toml setuptools before 77, as in Ubuntu 24.04, takes a table, and later a text.
    license='Apache-2.0',
    ext_modules=[]
    if NATIVE == 'none'
    else [
        Extension(
            'ros2cc_extract.checker._core',
            sources=[f'ros2cc_extract/checker/native/{name}.cpp' for name in ('binding', 'core')],
            depends=[
                f'ros2cc_extract/checker/native/{name}.hpp'
                for name in (
                    'core',
                    'memory',
                    'model',
                    'layout',
                    'machine',
                    'symmetry',
                    'moves',
                    'store',
                    'predicates',
                    'goals',
                    'expander',
                    'explore',
                    'chains',
                    'lasso',
                )
            ],
            include_dirs=INCLUDES,
            language='c++',
            extra_compile_args=['-std=c++17', '-O3', '-fvisibility=hidden', '-g0', '-pthread'],
            extra_link_args=['-pthread'],
            optional=IS_OPTIONAL,
        ),
        Extension(
            'ros2cc_extract.extract.live._journal',
            sources=['ros2cc_extract/extract/live/native/journal.c'],
            extra_compile_args=['-std=c11', '-O2', '-fvisibility=hidden', '-g0'],
            optional=IS_OPTIONAL,
        ),
        # No module: a running process loads it, of whatever version its Python is.
        Extension(
            'ros2cc_extract.extract.live._enter',
            sources=['ros2cc_extract/extract/live/native/enter.c'],
            extra_compile_args=['-std=c11', '-O2', '-fvisibility=hidden', '-g0', '-pthread'],
            extra_link_args=['-pthread', '-ldl'],
            optional=IS_OPTIONAL,
        ),
    ],
)
