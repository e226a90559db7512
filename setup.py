"""Builds the native core of the checker; everything else stands in ``pyproject.toml``."""

import sys

from setuptools import Extension, setup

try:
    import pybind11
except ImportError:
    # Built without isolation and without pybind11: the checker then is pure Python.
    setup()
    sys.exit()

setup(
    ext_modules=[
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
                    'moves',
                    'store',
                    'predicates',
                    'explore',
                    'lasso',
                )
            ],
            include_dirs=[pybind11.get_include()],
            language='c++',
            extra_compile_args=['-std=c++17', '-O3', '-fvisibility=hidden', '-g0'],
            # Without a compiler the package still works: the checker then is pure Python.
            optional=True,
        )
    ]
)
