"""
Packages of one repository that know of each other by their ``package.xml``.

Read as text: a foreign manifest is data that may be broken or hostile.
"""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path

from ros2cc_extract.files import Files

_MANIFEST = 'package.xml'
_NAME = re.compile(r'<name>\s*([\w.\-]+)\s*</name>')
_DEPENDS = re.compile(r'<(?:\w+_)?depend\b[^>]*>\s*([\w.\-]+)\s*<')
_COMMENT = re.compile(r'<!--.*?-->', re.DOTALL)
_LEVELS = 6
_DEPTH = 4
_SKIPPED = frozenset({'build', 'install', 'log', 'node_modules', 'venv', '__pycache__'})
_READ_AT_MOST = 1_000_000


def home_of(files: Files, folder: Path, package: str) -> Path | None:
    """The folder of ``package``, if the package that ``folder`` is in depends on it."""
    above = _self_and_above(folder)
    mine = next((each for each in above if files.is_file(each / _MANIFEST)), None)
    if mine is None or package not in _depends_of(files, mine):
        return None
    root = next((each for each in _self_and_above(mine) if files.exists(each / '.git')), None)
    return _packages_under(files, root or mine.parent).get(package)


def _self_and_above(folder: Path) -> list[Path]:
    return [folder, *list(folder.parents)[:_LEVELS]]


@lru_cache(maxsize=256)
def _depends_of(files: Files, package: Path) -> frozenset[str]:
    return frozenset(_DEPENDS.findall(_text_of(files, package / _MANIFEST)))


@lru_cache(maxsize=16)
def _packages_under(files: Files, root: Path) -> dict[str, Path]:
    """
    The packages in a repository, by name; nothing is looked for inside of them.

    A folder that is barred has none to give.
    """
    found: dict[str, Path] = {}
    for base, folders, names in files.walk(root, lambda error: None):
        here = Path(base)
        deep = len(here.relative_to(root).parts) >= _DEPTH
        if _MANIFEST in names:
            name = _NAME.search(_text_of(files, here / _MANIFEST))
            found.setdefault(name.group(1) if name else here.name, here)
        if deep or _MANIFEST in names:
            folders.clear()
        folders[:] = sorted(f for f in folders if f not in _SKIPPED and not f.startswith('.'))
    return found


def _text_of(files: Files, path: Path) -> str:
    try:
        text = files.read(path, _READ_AT_MOST).decode(errors='replace')
    except OSError:
        return ''
    return _COMMENT.sub('', text)
