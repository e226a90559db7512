"""
Starts the program that is to be steered, as ``python launch.py FILE [FUNCTION [ARGUMENT…]]``.

A file with an ``if __name__ == '__main__'`` runs as a script would; of any other, FUNCTION is
called, as a console script does. Modules of a package are run by their dotted name, so that
relative imports work. Runs with the user's interpreter: the standard library only.
"""

from __future__ import annotations

import ast
import importlib
import os
import runpy
import sys


def main() -> None:
    file = os.path.abspath(sys.argv[1])  # noqa: PTH100
    function = sys.argv[2] if len(sys.argv) > 2 else ''
    sys.argv = [file, *sys.argv[3:]]
    root, name = _package_of(file)
    sys.path[0] = root
    with open(file, encoding='utf-8') as stream:  # noqa: PTH123
        runs_by_itself = _runs_by_itself(ast.parse(stream.read()))
    if runs_by_itself or not function:
        if '.' in name:
            runpy.run_module(name, run_name='__main__', alter_sys=True)
        else:
            runpy.run_path(file, run_name='__main__')
        return
    getattr(importlib.import_module(name), function)()


def _package_of(file: str) -> tuple[str, str]:
    """Give the folder that is to be searched, and the dotted name below it."""
    folder, base = os.path.split(file)
    parts = [base.removesuffix('.py')]
    while os.path.exists(os.path.join(folder, '__init__.py')):  # noqa: PTH110, PTH118
        folder, package = os.path.split(folder)
        parts.insert(0, package)
    return folder, '.'.join(parts)


def _runs_by_itself(tree: ast.Module) -> bool:
    """Whether there is a test for the name of a script."""
    return any(
        isinstance(node, ast.If) and '__main__' in ast.unparse(node.test) for node in tree.body
    )


if __name__ == '__main__':
    main()
