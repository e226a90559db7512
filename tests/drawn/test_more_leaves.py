"""A behaviour tree of several leaves, in each of which its tick may stay."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

TREE = (Path(__file__).parent / 'patrol_tree.py').read_text(encoding='utf-8')
CLIENT = "ActionClient(self, Fibonacci, 'drive'"
OF_ITS_OWN = f'{CLIENT}, callback_group=ReentrantCallbackGroup()'


def verified(path: Path, leaves: str, client: str) -> list[dict[str, object]]:
    """Verify a tree of so many leaves."""
    path.write_text(TREE.replace('in (3,)', f'in ({leaves})').replace(CLIENT, client))
    out, err = StringIO(), StringIO()
    options = ['--profile', 'rclpy', '--timeout', '120', '--output-format', 'json']
    main(['verify', '--checker', 'embedded', *options, str(path)], out, err)
    queries: list[dict[str, object]] = json.loads(out.getvalue())['queries']
    return queries


@pytest.mark.parametrize('leaves', ['3, 1', pytest.param('3, 1, 2', marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    ('client', 'ends'), [(CLIENT, 'not satisfied'), (OF_ITS_OWN, 'satisfied')], ids=['bad', 'good']
)
def test_all_is_decided(tmp_path: Path, leaves: str, client: str, ends: str) -> None:
    said = verified(tmp_path / 'robot.py', leaves, client)
    assert not [query['words'] for query in said if query['verdict'] == 'undecided']
    asked = {'progress', 'deadlock'}
    assert {query['verdict'] for query in said if query['family'] in asked} == {ends}
