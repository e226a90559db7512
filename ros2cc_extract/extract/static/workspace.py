"""
Packages of one repository that know of each other by their ``package.xml``.

Read as text: a manifest of somebody else is data that may be broken or hostile.
"""

from __future__ import annotations

import os
import re
from functools import lru_cache
from pathlib import Path

_MANIFEST = 'package.xml'
_NAME = re.compile(r'<name>\s*([\w.\-]+)\s*</name>')
_DEPENDS = re.compile(r'<(?:\w+_)?depend\b[^>]*>\s*([\w.\-]+)\s*<')
_COMMENT = re.compile(r'<!--.*?-->', re.DOTALL)
_LEVELS = 6
_DEPTH = 4
_SKIPPED = frozenset({'build', 'install', 'log', 'node_modules', 'venv', '__pycache__'})
_READ_AT_MOST = 100_000


def home_of(folder: Path, package: str) -> Path | None:
    """The folder of ``package``, if the package that ``folder`` is in depends on it."""
    mine = next(
        (above for above in _self_and_above(folder) if (above / _MANIFEST).is_file()), None
    )
    if mine is None or package not in _depends_of(mine):
        return None
    root = next((above for above in _self_and_above(mine) if (above / '.git').exists()), None)
    return _packages_under(root or mine.parent).get(package)


def _self_and_above(folder: Path) -> list[Path]:
    return [folder, *list(folder.parents)[:_LEVELS]]


@lru_cache(maxsize=256)
def _depends_of(package: Path) -> frozenset[str]:
    return frozenset(_DEPENDS.findall(_text_of(package / _MANIFEST)))


@lru_cache(maxsize=16)
def _packages_under(root: Path) -> dict[str, Path]:
    """The packages in a repository, by name; nothing is looked for inside of them."""
    found: dict[str, Path] = {}
    for base, folders, files in os.walk(root):
        here = Path(base)
        deep = len(here.relative_to(root).parts) >= _DEPTH
        if _MANIFEST in files:
            name = _NAME.search(_text_of(here / _MANIFEST))
            found.setdefault(name.group(1) if name else here.name, here)
        if deep or _MANIFEST in files:
            folders.clear()
        folders[:] = sorted(f for f in folders if f not in _SKIPPED and not f.startswith('.'))
    return found


def _text_of(path: Path) -> str:
    try:
        with path.open(encoding='utf-8', errors='replace') as file:
            return _COMMENT.sub('', file.read(_READ_AT_MOST))
    except OSError:
        return ''
