"""
Nodes of the repository on a page of the documentation: source, what is printed, what mends it.

A paragraph of a page that is one link to a Python file stands for the file; its title says what is
shown of it. Where the page is read without the site, the link still leads to the file.

    [navigator.py](../../tests/bugs/b10_call_in_own_group.py "the node")
    [navigator.py](../../tests/bugs/b10_call_in_own_group.py "what is printed")
    [navigator.py](../../tests/bugs/b10_call_in_own_group_mended.py "the change")

The text of the link is the name under which the node is checked.
"""

from __future__ import annotations

import ast
import difflib
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path

SHOWN = re.compile(r'^\[([\w.]+)\]\((\S+\.py) "([^"]+)"\)$', re.MULTILINE)
MARK = '\n# finds: '
TWINS = (('_mended', ''), ('_good', '_bad'))
COMMAND = 'ros2cc-extract'


def expanded(page: str, folder: Path) -> str:
    """
    Put what the links of ``page`` stand for in their places.

    :param folder: where the page lies, to which its links are relative.
    """
    return SHOWN.sub(lambda link: SHOWS[link[3]](link[1], (folder / link[2]).resolve()), page)


def source(path: Path) -> str:
    """Give a node as readers see it: without the text that names its bug, and the test's mark."""
    text = path.read_text(encoding='utf-8').partition(MARK)[0].rstrip() + '\n'
    first = ast.parse(text).body[0]
    if not (isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)):
        return text
    return ''.join(text.splitlines(keepends=True)[first.end_lineno :]).lstrip('\n')


@cache
def printed(name: str, text: str) -> str:
    """Check ``text`` as the file ``name`` and give all that a pipe gets."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / name).write_text(text, encoding='utf-8')
        done = subprocess.run(
            [sys.executable, '-m', 'ros2cc_extract.cli.main', name],
            cwd=folder,
            env={**_environment(), 'XDG_CACHE_HOME': folder},
            capture_output=True,
            text=True,
            check=False,
        )
    if done.returncode not in (0, 1) or done.stderr:
        raise RuntimeError(f'{name}: status {done.returncode}: {done.stderr}')
    return done.stdout


def _environment() -> dict[str, str]:
    return {name: value for name, value in os.environ.items() if name != 'COLUMNS'}


def _node(name: str, path: Path) -> str:
    text = source(path)
    found = re.findall(rf'^{re.escape(name)}:(\d+):', printed(name, text), re.MULTILINE)
    marked = ' '.join(sorted(set(found), key=int))
    options = f'title="{name}" linenums="1" hl_lines="{marked}"'
    return f'```python {options}\n{text}```'


def _printed(name: str, path: Path) -> str:
    return f'```console\n$ {COMMAND} {name}\n{printed(name, source(path))}```'


def _change(name: str, path: Path) -> str:
    before, after = source(faulty_twin(path)), source(path)
    lines = list(difflib.unified_diff(before.splitlines(), after.splitlines(), n=2, lineterm=''))
    last = printed(name, after).splitlines()[-1]
    return (
        f'```diff title="{name}"\n' + '\n'.join(lines[2:]) + '\n```\n\n'
        f'```console\n$ {COMMAND} {name} | tail -n 1\n{last}\n```'
    )


def faulty_twin(path: Path) -> Path:
    """Give the node that ``path`` mends."""
    for ending, instead in TWINS:
        if path.stem.endswith(ending):
            return path.with_name(path.stem.removesuffix(ending) + instead + path.suffix)
    raise ValueError(f'{path.name} is no mended node')


SHOWS: Mapping[str, Callable[[str, Path], str]] = {
    'the node': _node,
    'what is printed': _printed,
    'the change': _change,
}
