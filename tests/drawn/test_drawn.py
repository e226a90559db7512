"""
What the tool says of nodes that were written without sight of its rules.

Each stands twice in ``table.yaml``: with a fault, and mended. All that is said is compared, but
for advice on the set-up.
"""

from __future__ import annotations

import json
import shutil
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
import yaml

from ros2cc_extract.cli.main import main

HERE = Path(__file__).parent
ROWS = yaml.safe_load((HERE / 'table.yaml').read_text(encoding='utf-8'))
ADVICE = ('CC4', 'CC5')
NO_ADVICE = 'CC406'  # the node is lost


def said(node: str) -> list[str]:
    """``code file:line`` of each finding; the nodes lie not among tests, of which less is said."""
    out, err = StringIO(), StringIO()
    with TemporaryDirectory() as folder:
        for path in HERE.glob('*.py'):
            if path.stem == node or 'helper' in path.stem:
                shutil.copy(path, folder)
        command = ['check', '--no-cache', '--output-format', 'json']
        main([*command, f'{folder}/{node}.py'], out, err)
    found = json.loads(out.getvalue())['findings']
    return [
        f'{each["code"]} {Path(each["path"]).name}:{each["line"]}'
        for each in found
        if each['code'] == NO_ADVICE or not each['code'].startswith(ADVICE)
    ]


def cases() -> list[object]:
    """Those that come to the limit of time are long; what they say of it is not compared."""
    marks = [(pytest.mark.slow,) if 'has' in row else () for row in ROWS]
    return [pytest.param(row, id=row['node'], marks=m) for row, m in zip(ROWS, marks, strict=True)]


@pytest.mark.parametrize('row', cases())
def test_the_tool_says_of_a_drawn_node_what_is_true(row: dict[str, object]) -> None:
    found = said(str(row['node']))
    if 'has' in row:
        assert [each for each in found if each.startswith('CC1') and 'CC12' not in each] == row[
            'has'
        ]
    else:
        assert found == row['says']


def test_every_node_is_in_the_table() -> None:
    names = {path.stem for path in HERE.glob('*.py')}
    nodes = {name for name in names if 'helper' not in name and not name.startswith('test_')}
    assert {row['node'] for row in ROWS} == nodes
