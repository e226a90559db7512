"""Nodes of the table on real rclpy: a few here, all of them as ``slow`` and by ``make shapes``."""

from __future__ import annotations

import subprocess

import pytest

from tests.live.interpreters import EVERY_RELEASE, interpreter_of
from tests.shapes.observe import NOT_RUN, observe
from tests.shapes.rows import OTHERWISE, Node, nodes
from tests.support.domains import free_domain

pytestmark = pytest.mark.live
EVERY = 80
OF_MAJOR = {'7': 'jazzy', '9': 'kilted'}
MAJOR = "from importlib.metadata import version; print(version('ros-rclpy').partition('.')[0])"
CASES = [
    pytest.param(node, id=node.name, marks=() if at // 2 % EVERY == 0 else (pytest.mark.slow,))
    for at, node in enumerate(nodes())
]


@pytest.mark.parametrize('variable', EVERY_RELEASE)
@pytest.mark.parametrize('node', CASES)
def test_a_node_does_what_the_table_says(node: Node, variable: str) -> None:
    python = interpreter_of(variable)
    major = subprocess.run([python, '-c', MAJOR], capture_output=True, text=True, check=False)
    expected = node.observed.get(OF_MAJOR.get(major.stdout.strip(), ''), NOT_RUN)
    if expected == NOT_RUN:
        pytest.skip('no wheel has what it needs, or the table does not tell of this release')
    with free_domain() as domain:
        seen = observe(node, python, domain)
    assert seen.what in expected.split(OTHERWISE), seen.output
