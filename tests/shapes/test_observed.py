"""Nodes of the table on real rclpy: a few here, all of them as ``slow`` and by ``make shapes``."""

from __future__ import annotations

import subprocess
from concurrent.futures import ThreadPoolExecutor

import pytest

from tests.live.interpreters import EVERY_RELEASE, EVERY_RELEASE_AT_LEISURE, interpreter_of
from tests.shapes.observe import NOT_RUN, Seen, observe
from tests.shapes.rows import OTHERWISE, Node, nodes
from tests.support.domains import free_domain

pytestmark = pytest.mark.live
EVERY = 80
FEW = [node for at, node in enumerate(nodes()) if at // 2 % EVERY == 0]
OF_MAJOR = {'7': 'jazzy', '9': 'kilted'}
MAJOR = "from importlib.metadata import version; print(version('ros-rclpy').partition('.')[0])"


def expected_on(python: str, node: Node) -> str:
    """What the table says of the release that ``python`` has."""
    major = subprocess.run([python, '-c', MAJOR], capture_output=True, text=True, check=False)
    return node.observed.get(OF_MAJOR.get(major.stdout.strip(), ''), NOT_RUN)


def seen_on(python: str, node: Node) -> Seen:
    with free_domain() as domain:
        return observe(node, python, domain)


@pytest.mark.parametrize('variable', EVERY_RELEASE_AT_LEISURE)
def test_a_few_nodes_do_what_the_table_says(variable: str) -> None:
    """Side by side: a node is looked at for seconds, in which it does next to nothing."""
    python = interpreter_of(variable)
    expected = {node: expected_on(python, node) for node in FEW}
    run = [node for node in FEW if expected[node] != NOT_RUN]
    with ThreadPoolExecutor(len(FEW)) as pool:
        seen = dict(zip(run, pool.map(lambda node: seen_on(python, node), run), strict=True))
    assert run
    for node in run:
        assert seen[node].what in expected[node].split(OTHERWISE), (node.name, seen[node].output)


@pytest.mark.slow
@pytest.mark.parametrize('variable', EVERY_RELEASE)
@pytest.mark.parametrize(
    'node', [pytest.param(node, id=node.name) for node in nodes() if node not in FEW]
)
def test_a_node_does_what_the_table_says(node: Node, variable: str) -> None:
    python = interpreter_of(variable)
    expected = expected_on(python, node)
    if expected == NOT_RUN:
        pytest.skip('no wheel has what it needs, or the table does not tell of this release')
    seen = seen_on(python, node)
    assert seen.what in expected.split(OTHERWISE), seen.output
