"""Paths as the services want them: relative to the root of the repository, with ``/``."""

from __future__ import annotations

import posixpath
from urllib.parse import quote


def relative(file: str, root: str = '') -> str:
    """
    Give ``file`` relative to ``root``, both as text; a file elsewhere stays as it is.

    :param root: absolute path of the repository; empty when files are relative to it already.
    """
    path = posixpath.normpath(file.replace('\\', '/'))
    base = posixpath.normpath(root.replace('\\', '/')) if root else ''
    if base and path.startswith(base.rstrip('/') + '/'):
        return path[len(base.rstrip('/')) + 1 :]
    return path


def as_uri(path: str) -> str:
    """Write a path as a URI reference."""
    quoted = quote(path)
    return f'file://{quoted}' if path.startswith('/') else quoted
