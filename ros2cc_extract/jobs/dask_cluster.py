"""
Jobs done by the workers of a Dask cluster.

Dask hands the jobs of a worker that is lost to another. What no worker can do, because a job fails
there, because no worker is left, or because the scheduler itself is gone, is done here.
"""

from __future__ import annotations

import importlib.util
import logging
import re
import socket
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from queue import Empty, SimpleQueue
from typing import Any, TypeVar

from ros2cc_extract.cache_file import tool_version
from ros2cc_extract.deadline import GRACE_S, Deadline
from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.jobs.pools import Answers
from ros2cc_extract.light_dataclasses import dataclass

Job = TypeVar('Job')
Answer = TypeVar('Answer')

ADDRESS = re.compile(r'(?:tcp|tls)://(\[[0-9a-fA-F:]+\]|[^:/\[\]\s]+):(\d{1,5})')
CONNECTING_S = 10.0
LOOK_S = 1.0
"""After so long without an answer it is asked whether there are still workers."""
WITHOUT_WORKERS_S = 20.0
"""A nanny starts another worker by then."""
FETCHING_S = 60.0
BATCHES_OF_A_WORKER = 16
_ONE_AT_A_TIME = threading.Lock()


def cluster_at(address: str) -> DaskCluster:
    """
    The cluster of the scheduler at ``address``.

    :raises ToolNotFoundError: when Dask is not installed.
    :raises InputError: if no scheduler answers there.
    """
    if importlib.util.find_spec('distributed') is None:
        what = 'Dask is not installed here'
        raise ToolNotFoundError(what, None, "install it: pip install 'ros2cc-extract[dask]'")
    found = ADDRESS.fullmatch(address)
    if found is None:
        raise InputError(f'{address!r} is no address', None, 'write tcp://HOST:PORT')
    try:
        # Not with Dask's client: its threads would stay, and a scan could not fork any more.
        socket.create_connection((found[1].strip('[]'), int(found[2])), CONNECTING_S).close()
    except (OSError, OverflowError) as error:
        raise _unreachable(address, error) from None
    return DaskCluster(address)


@dataclass(frozen=True)
class DaskCluster:
    """
    The workers of one scheduler, each of which does one job at a time.

    :param address: as ``tcp://HOST:PORT``.
    """

    address: str
    is_remote: bool = True
    size: int = 2

    def each(
        self,
        work: Callable[[Job], Answer],
        jobs: Sequence[Job],
        until: Deadline | None = None,
    ) -> Answers[Answer]:
        """See ``Pool``."""
        answered = set()
        if jobs:
            with _client(self.address) as client:
                for number, answer in _answers(client, work, jobs, until):
                    answered.add(number)
                    yield number, answer
        for number, job in enumerate(jobs):
            if number not in answered:
                yield number, work(job)


@contextmanager
def _client(address: str) -> Iterator[Any]:
    """
    Connect, and see that all workers run this program.

    What Dask would log goes nowhere: what matters of it shows in the answers.
    """
    with warnings.catch_warnings():
        warnings.simplefilter('ignore')
        logging.disable(logging.CRITICAL)
        try:
            client = _connected(address)
            try:
                _compare_versions(client, address)
                yield client
            finally:
                client.close()
        finally:
            logging.disable(logging.NOTSET)


def _connected(address: str) -> Any:
    from distributed import Client

    connect: Callable[..., Any] = Client
    try:
        return connect(address, timeout=CONNECTING_S, set_as_default=False)
    except (OSError, ValueError) as error:
        raise _unreachable(address, error) from None


def _unreachable(address: str, error: Exception) -> InputError:
    reason = (getattr(error, 'strerror', None) or str(error) or type(error).__name__).splitlines()
    return InputError(
        f'no Dask scheduler answers at {address}: {reason[0]}', None, 'start it: dask scheduler'
    )


def _compare_versions(client: Any, address: str) -> None:
    """
    Answers are the same everywhere only if the program is.

    :raises InputError: when there is no worker, or it runs another one.
    """
    same = 'start: dask worker, where the same version of ros2cc-extract and Python is installed'
    try:
        versions = client.run(tool_version)
    except Exception as error:  # a worker may fail in any way
        what = f'a worker of {address} cannot run ros2cc-extract: {type(error).__name__}'
        raise InputError(what, None, same) from None
    if not versions:
        raise InputError(f'the Dask scheduler at {address} has no worker', None, same)
    others = [worker for worker, version in versions.items() if version != tool_version()]
    if others:
        what = f'the worker {others[0]} runs another version of ros2cc-extract or of Python'
        raise InputError(what, None, same)


def _answers(
    client: Any, work: Callable[[Job], Answer], jobs: Sequence[Job], until: Deadline | None
) -> Iterator[tuple[int, Answer]]:
    """Give what workers answer, as long as there are any."""
    ended: SimpleQueue[int] = SimpleQueue()
    batches = _batches(len(jobs), len(client.nthreads()))
    given = [[jobs[number] for number in batch] for batch in batches]
    futures = client.map(partial(_there, tool_version(), work), given, pure=False)
    for place, future in enumerate(futures):
        future.add_done_callback(lambda _, place=place: ended.put(place))
    left, alone_s = len(batches), 0.0
    while left and not _is_past(until):
        try:
            place = ended.get(timeout=LOOK_S)
        except Empty:
            alone_s = 0.0 if _has_workers(client) else alone_s + LOOK_S
            if alone_s > WITHOUT_WORKERS_S:
                return
            continue
        left -= 1
        answers = _fetched(futures[place]) or ()
        for number, answer in zip(batches[place], answers, strict=False):
            if answer is not None:
                yield number, answer[0]


def _batches(jobs: int, workers: int) -> list[range]:
    """
    Which jobs are one task of Dask, whose scheduler needs some ms for each.

    Each worker gets several, so that at the end none of them has much more to do than another.
    """
    size = max(1, jobs // (BATCHES_OF_A_WORKER * max(1, workers)))
    return [range(begin, min(begin + size, jobs)) for begin in range(0, jobs, size)]


def _there(
    version: str, work: Callable[[Job], Answer], jobs: Sequence[Job]
) -> list[tuple[Answer] | None]:
    """
    Run on a worker, also on one that has come later; threads of one wait for each other.

    :return: an answer for each job; ``None`` for one that fails here, as the others may not.
    """
    if tool_version() != version:
        raise RuntimeError('this worker runs another version')
    with _ONE_AT_A_TIME:
        return [_tried(work, job) for job in jobs]


def _tried(work: Callable[[Job], Answer], job: Job) -> tuple[Answer] | None:
    try:
        return (work(job),)
    except Exception:  # done once more where it can be shown
        return None


def _fetched(future: Any) -> Any:
    """The result of a task; ``None`` if it has none for any reason."""
    try:
        return future.result(timeout=FETCHING_S)
    except BaseException as error:
        # A lost future ends by ``CancelledError``, which is no ``Exception`` in some versions.
        if isinstance(error, KeyboardInterrupt | SystemExit | GeneratorExit):
            raise
        return None


def _has_workers(client: Any) -> bool:
    try:
        return client.status == 'running' and bool(client.nthreads())
    except Exception:  # the scheduler is lost, and may come again
        return False


def _is_past(until: Deadline | None) -> bool:
    return until is not None and Deadline(until.at + GRACE_S, until.reason).is_over
