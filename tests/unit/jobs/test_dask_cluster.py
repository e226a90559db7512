"""Jobs on a Dask cluster: the same answers, whatever happens to its workers."""

from __future__ import annotations

import importlib.util
import os
import socket
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest

from ros2cc_extract.cache_file import tool_version
from ros2cc_extract.deadline import Deadline
from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.jobs import dask_cluster as tested
from ros2cc_extract.jobs.dask_cluster import cluster_at
from ros2cc_extract.jobs.pools import Processes, in_order
from tests.support.dask_cluster import Cluster, dask_cluster

needs_dask = pytest.mark.skipif(
    importlib.util.find_spec('distributed') is None, reason='Dask is not installed'
)


@pytest.fixture
def cluster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Cluster]:
    """Workers that find this file's functions."""
    here = Path(__file__)
    monkeypatch.setenv('PYTHONPATH', f'{here.parent}{os.pathsep}{here.parents[3]}')
    with dask_cluster(tmp_path, 2) as found:
        yield found


def _squared(here: int, job: int) -> tuple[int, bool]:
    """With whether it was done in the process that runs the tests."""
    time.sleep(0.05)
    return job * job, os.getpid() == here


squared = partial(_squared, os.getpid())


def test_dask_may_not_be_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, 'find_spec', lambda name: None)
    with pytest.raises(ToolNotFoundError) as caught:
        cluster_at('tcp://127.0.0.1:8786')
    told = "Dask is not installed here; install it: pip install 'ros2cc-extract[dask]'"
    assert str(caught.value) == told


@pytest.mark.parametrize('address', ['8786', 'host:8786', 'http://host:8786', 'tcp://host'])
def test_what_is_no_address_is_refused(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, 'find_spec', lambda name: object())
    with pytest.raises(InputError, match=r'is no address; write tcp://HOST:PORT'):
        cluster_at(address)


def test_nobody_answers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, 'find_spec', lambda name: object())
    with socket.create_server(('127.0.0.1', 0)) as free:
        port = free.getsockname()[1]
    with pytest.raises(InputError) as caught:
        cluster_at(f'tcp://127.0.0.1:{port}')
    told = f'no Dask scheduler answers at tcp://127.0.0.1:{port}: Connection refused'
    assert str(caught.value) == f'{told}; start it: dask scheduler'


@needs_dask
def test_answers_are_those_of_this_machine(cluster: Cluster) -> None:
    there = in_order(cluster_at(cluster.address), squared, range(20))
    assert there == [(n * n, False) for n in range(20)]


def grumbling(here: int, job: int) -> tuple[int, bool]:
    if job % 2 and os.getpid() != here:
        raise LookupError(job)
    return _squared(here, job)


@needs_dask
def test_answers_of_many_jobs_are_in_order(cluster: Cluster) -> None:
    """More jobs than tasks, and each task is of several."""
    there = in_order(cluster_at(cluster.address), squared, range(100))
    assert there == [(n * n, False) for n in range(100)]


@needs_dask
def test_what_fails_of_many_is_done_here(cluster: Cluster) -> None:
    there = in_order(cluster_at(cluster.address), partial(grumbling, os.getpid()), range(100))
    assert there == [(n * n, bool(n % 2)) for n in range(100)]


@needs_dask
def test_what_fails_there_is_done_here(cluster: Cluster) -> None:
    assert in_order(cluster_at(cluster.address), partial(grumbling, os.getpid()), range(4)) == [
        (0, False),
        (1, True),
        (4, False),
        (9, True),
    ]


@needs_dask
def test_a_worker_that_is_killed_changes_nothing(cluster: Cluster) -> None:
    answers = {}
    for number, answer in cluster_at(cluster.address).each(squared, range(60)):
        answers[number] = answer
        if len(answers) == 10:
            cluster.kill(0)
    assert answers == {n: (n * n, False) for n in range(60)}


@needs_dask
def test_without_any_worker_the_rest_is_done_here(
    cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tested, 'WITHOUT_WORKERS_S', 1.0)
    answers = {}
    for number, answer in cluster_at(cluster.address).each(squared, range(30)):
        answers[number] = answer
        if len(answers) == 5:
            cluster.kill(0)
            cluster.kill(1)
    assert {number: root for number, (root, _) in answers.items()} == {n: n * n for n in range(30)}
    assert sum(is_here for _, is_here in answers.values()) > 0


def endless(until: Deadline, job: int) -> str:
    if until.is_over:
        return 'not begun'
    time.sleep(30)
    return 'done'


@needs_dask
def test_nobody_waits_past_the_time(cluster: Cluster) -> None:
    until = Deadline(time.monotonic() + 1, 'over')
    pool = cluster_at(cluster.address)
    answers = dict(pool.each(partial(endless, until), range(3), until))
    assert answers == dict.fromkeys(range(3), 'not begun')


@needs_dask
def test_a_scheduler_without_workers_is_told(tmp_path: Path) -> None:
    with dask_cluster(tmp_path, 0) as found, pytest.raises(InputError, match='has no worker'):
        in_order(cluster_at(found.address), squared, range(2))


class Client:
    """Of workers that say which version they run."""

    def __init__(self, *versions: str) -> None:
        self._versions = versions

    def run(self, work: object) -> dict[str, str]:
        return {f'tcp://worker:{n}': version for n, version in enumerate(self._versions)}


def test_a_worker_of_another_version_is_told() -> None:
    with pytest.raises(InputError, match='the worker tcp://worker:1 runs another version of'):
        tested._compare_versions(Client(tool_version(), 'another'), 'tcp://host:1')
    tested._compare_versions(Client(tool_version(), tool_version()), 'tcp://host:1')


def test_a_worker_of_another_version_that_comes_later_answers_nothing() -> None:
    with pytest.raises(RuntimeError):
        tested._there('another', squared, [3])


def test_many_jobs_are_few_tasks() -> None:
    assert tested._batches(0, 2) == []
    assert tested._batches(40, 2) == [range(n, n + 1) for n in range(40)]
    many = tested._batches(400, 2)
    assert (len(many), many[:2], many[-1]) == (34, [range(0, 12), range(12, 24)], range(396, 400))
    assert [n for batch in many for n in batch] == list(range(400))
    assert len(tested._batches(400, 0)) == 16


def test_one_job_of_a_batch_that_fails_takes_no_other_with_it() -> None:
    there = tested._there(tool_version(), partial(grumbling, -1), [2, 3, 4])
    assert there == [((4, False),), None, ((16, False),)]


def test_both_pools_say_what_they_are() -> None:
    assert (Processes(3).size, Processes(3).is_remote) == (3, False)
    pool = tested.DaskCluster('tcp://127.0.0.1:1')
    assert (pool.size > 1, pool.is_remote) == (True, True)
