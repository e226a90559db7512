"""Units and sweeps on a Dask cluster: the same report, whatever happens to the workers."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.e2e.conftest import EXAMPLES, ROOT, Run, environment
from tests.support.dask_cluster import Cluster, dask_cluster
from tests.support.knots import write_knots
from tests.support.trees import write_tree

pytest.importorskip('distributed', reason='Dask is not installed')


@pytest.fixture
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    with dask_cluster(tmp_path_factory.mktemp('dask'), 2) as found:
        yield found


@pytest.mark.parametrize('form', ['text', 'json'])
def test_a_check_says_the_same(run: Run, tmp_path: Path, cluster: Cluster, form: str) -> None:
    write_tree(tmp_path / 'tree')
    told = ('tree', '--output-format', form, '--no-cache')
    expected = run(*told)
    assert expected.status == 1
    assert run(*told, '--dask', cluster.address) == expected


def test_answers_of_workers_are_kept_here(run: Run, tmp_path: Path, cluster: Cluster) -> None:
    write_tree(tmp_path / 'tree')
    expected = run('tree', '--dask', cluster.address)
    assert run('tree') == expected


def sweep(run: Run, *more: object) -> Any:
    """The sweep as data, without what each run of it costs."""
    told = run(
        *('verify', EXAMPLES / 'two_groups' / 'node.py', '--threads', '1..4'),
        *('--max-cycle', '1..2', '--output-format', 'json', *more),
    )
    assert (told.status, told.err) == (0, '')
    return [without_cost(point) for point in json.loads(told.out)]


def without_cost(point: dict[str, Any]) -> dict[str, Any]:
    queries = [query | {'seconds': 0} for query in point['queries']]
    return point | {'seconds': 0, 'peak_mb': 0, 'queries': queries}


def test_a_sweep_says_the_same(run: Run, cluster: Cluster) -> None:
    assert sweep(run, '--dask', cluster.address) == sweep(run)


def test_a_worker_that_is_killed_changes_nothing(
    run: Run, tmp_path: Path, cluster: Cluster, cache: Path
) -> None:
    write_knots(tmp_path / 'src', 30, callers=3)
    expected = run('src', '--no-cache', '--max-seconds', 600)
    told = ('src', '--max-seconds', '600', '--dask', cluster.address)
    child = subprocess.Popen(
        [sys.executable, '-m', 'ros2cc_extract.cli.main', *told],
        cwd=tmp_path,
        env=environment(cache),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    while not list(cache.rglob('*.verdicts')):
        assert child.poll() is None
    cluster.kill(0)
    out, err = child.communicate(timeout=300)
    assert (child.returncode, out, err) == (expected.status, expected.out, expected.err)


def test_one_model_is_no_list_of_jobs(run: Run) -> None:
    node = EXAMPLES / 'pool_exhaustion' / 'node.py'
    told = run('verify', node, '--dask', 'tcp://127.0.0.1:1')
    assert (told.status, told.out) == (2, '')
    assert 'only the points of a sweep are independent jobs' in told.err


def test_nobody_answers_is_one_line(run: Run) -> None:
    node = ROOT / 'launch_free_examples' / 'two_groups' / 'node.py'
    told = run(node, '--dask', 'tcp://127.0.0.1:1')
    assert (told.status, told.out) == (2, '')
    assert told.err == (
        'ros2cc-extract: error: no Dask scheduler answers at tcp://127.0.0.1:1: Connection '
        'refused; start it: dask scheduler\n'
    )
