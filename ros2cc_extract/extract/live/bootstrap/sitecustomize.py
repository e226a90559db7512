"""
Installs the hook in every Python process that has this folder on its PYTHONPATH.

Does nothing unless the environment asks for it, and lets the ``sitecustomize`` that would have
been found without this one run as well. Must never keep an interpreter from starting.
"""

import importlib.machinery
import importlib.util
import os
import sys

_HERE = os.path.dirname(os.path.abspath(__file__))  # noqa: PTH100, PTH120
_HOOK_PACKAGE = '_ros2cc_live'


def _load_hook() -> None:
    # By path and under a name of its own: neither the tool nor what it depends on need be
    # installed for the interpreter that runs the node.
    folder = os.path.dirname(_HERE)  # noqa: PTH120
    spec = importlib.util.spec_from_file_location(
        _HOOK_PACKAGE,
        os.path.join(folder, '__init__.py'),  # noqa: PTH118
        submodule_search_locations=[folder],
    )
    if spec is None or spec.loader is None:
        return
    package = importlib.util.module_from_spec(spec)
    sys.modules[_HOOK_PACKAGE] = package
    spec.loader.exec_module(package)
    importlib.import_module(f'{_HOOK_PACKAGE}.hook.wrapping').install_from_environment()


def _run_next_sitecustomize() -> None:
    others = [path for path in sys.path if os.path.abspath(path) != _HERE]  # noqa: PTH100
    sys.path[:] = others
    spec = importlib.machinery.PathFinder.find_spec('sitecustomize', others)
    if spec is None or spec.loader is None:
        return
    module = importlib.util.module_from_spec(spec)
    sys.modules['sitecustomize'] = module
    spec.loader.exec_module(module)


if os.environ.get('ROS2CC_LIVE_DIR'):
    try:
        _load_hook()
    except Exception as error:  # the program must run even if the hook fails
        print(f'ros2cc-extract: the hook cannot be installed: {error!r}', file=sys.stderr)
_run_next_sitecustomize()
