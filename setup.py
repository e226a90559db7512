"""Builds what is native: the checker, and the journal of the hook; the rest is pyproject.toml."""

from setuptools import Extension, setup

try:
    from pybind11 import get_include
except ImportError:
    # Built without isolation, as colcon does: the headers of pybind11-dev stand where a compiler
    # looks; without them the checker is pure Python.
    INCLUDES = []
else:
    INCLUDES = [get_include()]

setup(
    # colcon evaluates what it reads here as literals; from pyproject.toml this comes as none.
    python_requires='>=3.10',
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
            # Without a compiler the package still works: the checker then is pure Python.
            optional=True,
        ),
        Extension(
            'ros2cc_extract.extract.live._journal',
            sources=['ros2cc_extract/extract/live/native/journal.c'],
            extra_compile_args=['-std=c11', '-O2', '-fvisibility=hidden', '-g0'],
            # As above: the hook then is pure Python, and what it costs is in docs/live.md.
            optional=True,
        ),
    ],
)
