"""``why``: where running processes stand, and whether they can go on."""

from __future__ import annotations

import functools
import json
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TypeVar

from ros2cc_extract.errors import InputError, Ros2ccError, did_you_mean
from ros2cc_extract.extract.live.hang_analysis import probe
from ros2cc_extract.extract.live.hang_analysis.samples import look_of
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import (
    Explanation,
    Looks,
    explain,
    explain_together,
)
from ros2cc_extract.extract.live.injection import (
    check_process,
    inject,
    injectors,
    private_folder,
    user_to_enter,
)
from ros2cc_extract.files import read_regular
from ros2cc_extract.jobs.process_pool import ProcessPool
from ros2cc_extract.light_dataclasses import dataclass

T = TypeVar('T')
# From when it was let in; a busy process on a busy machine takes a second for each look.
PATIENCE_S = 4.0
_LOOK_EVERY_S = 0.01
_MOST_BYTES = 64_000_000
# They mostly wait for the processes to let them in.
_ENTERED_AT_ONCE = 8

# In a thread of its own: the one that is entered may hold locks, and goes on at once.
_LINES = """
import _thread
def _look(name='_ros2cc_standing'):
    import importlib.util, os
    path = {path!r}
    try:
        spec = importlib.util.spec_from_file_location(name, {probe!r})
        probe = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(probe)
        probe.look_twice(path, {go!r})
    except Exception as error:
        if os.path.isdir(os.path.dirname(path)):
            with open(path + '.failed', 'w') as stream:
                stream.write(repr(error))
_thread.start_new_thread(_look, ())
"""


@dataclass(frozen=True)
class Explained:
    """
    :param found: what was found of each process that runs nodes, in the order of their numbers.
    :param failures: why others could not be looked at.
    """

    found: tuple[Explanation, ...]
    failures: Mapping[int, str]


def explain_process(pid: int) -> Explanation:
    """
    Look twice at a running process, and judge it.

    :raises InputError: when there is no such process, it is another user's, has no node, or does
        not answer in time.
    :raises ToolNotFoundError: when nothing here can run code in it.
    """
    looks = _look_at([pid])[pid]
    if isinstance(looks, Ros2ccError):
        raise looks
    if not _has_nodes(looks):
        raise InputError(f'process {pid} has no rclpy node')
    return explain(pid, looks)


def explain_all(pids: Sequence[int]) -> Explained:
    """
    Look twice at processes that have loaded rclpy, and judge them together.

    :raises InputError: when none of them runs a node.
    """
    looks = _look_at(pids) if pids else {}
    seen = {
        pid: each for pid, each in looks.items() if isinstance(each, tuple) and _has_nodes(each)
    }
    failures = {pid: each.what for pid, each in looks.items() if isinstance(each, Ros2ccError)}
    if not seen and not failures:
        raise InputError('no process of yours on this machine runs an rclpy node')
    explained = explain_together(seen)
    return Explained(tuple(explained[pid] for pid in sorted(explained)), failures)


def explain_node(name: str, pids: Sequence[int]) -> Explanation:
    """
    Find the process that runs a node, and judge it together with the others.

    :param name: full, as in `/arm/planner`, or the end of a full name, as in `planner`.
    :raises InputError: when no process or more than one runs such a node.
    """
    explained = explain_all(pids)
    matches = [
        each for each in explained.found if any(_is_named(node, name) for node in each.look.nodes)
    ]
    if len(matches) == 1:
        return matches[0]
    if matches:
        numbers = ' and '.join(str(each.process) for each in matches)
        raise InputError(f'node {name!r} runs in processes {numbers}', None, 'give one of them')
    known = sorted({node for each in explained.found for node in each.look.nodes})
    mend = did_you_mean(name, known) or (f'there are: {", ".join(known)}' if known else '')
    failures = ''.join(f'; {each}' for each in explained.failures.values())
    raise InputError(f'no process of yours runs a node {name!r}{failures}', None, mend)


def _is_named(node: str, name: str) -> bool:
    return node == name if name.startswith('/') else node.endswith(f'/{name}')


def _has_nodes(looks: Looks) -> bool:
    return bool(looks[1].executors or looks[1].entities)


def _look_at(pids: Sequence[int]) -> dict[int, Looks | Ros2ccError]:
    """
    Look at all processes twice; after the last first look begins the first second one.

    So there is a moment between the looks that all of them have in common.
    """
    with private_folder() as folder:
        enter = functools.partial(_enter, folder=folder)
        with ProcessPool(enter, min(len(pids), _ENTERED_AT_ONCE)) as pool:
            refusals = dict(zip(pids, (error for error, _ in pool.ask(pids)), strict=True))
        entered = [pid for pid, error in refusals.items() if error is None]
        failures = {pid: error for pid, error in refusals.items() if error is not None}
        first, unready = _each(entered, functools.partial(_has_looked, folder))
        _go(folder).touch()
        looks, unanswered = _each(first, functools.partial(_looks, folder))
    return {**failures, **unready, **unanswered, **looks}


def _enter(pid: int, folder: Path) -> Ros2ccError | None:
    try:
        check_process(pid)
        user_to_enter(pid, other_user=False)
        # A main thread that stands in C runs nothing for `sys.remote_exec`: that comes last.
        ways = sorted(injectors(), key=lambda way: way.name == 'sys.remote_exec')
        script = folder / f'{pid}.py'
        lines = _LINES.format(
            path=str(_answer(folder, pid)), probe=probe.__file__, go=str(_go(folder))
        )
        script.write_text(lines, encoding='utf-8')
        inject(pid, script, ways)
    except Ros2ccError as error:
        return error
    return None


def _answer(folder: Path, pid: int) -> Path:
    return folder / f'{pid}.json'


def _go(folder: Path) -> Path:
    return folder / 'go'


def _each(
    pids: Iterable[int], answers: Callable[[int, float], T]
) -> tuple[dict[int, T], dict[int, Ros2ccError]]:
    """Collect what each process answers before the time is over, and why others do not."""
    deadline = time.monotonic() + PATIENCE_S
    found: dict[int, T] = {}
    failures: dict[int, Ros2ccError] = {}
    for pid in pids:
        try:
            found[pid] = answers(pid, deadline)
        except Ros2ccError as error:
            failures[pid] = error
    return found, failures


def _has_looked(folder: Path, pid: int, deadline: float) -> None:
    answer = _answer(folder, pid)
    _await(answer.with_name(f'{answer.name}{probe.FIRST_SUFFIX}'), answer, pid, deadline)


def _looks(folder: Path, pid: int, deadline: float) -> Looks:
    answer = _answer(folder, pid)
    _await(answer, answer, pid, deadline)
    try:
        before, after = map(look_of, json.loads(read_regular(answer, _MOST_BYTES))['looks'])
    except (KeyError, TypeError, ValueError, AttributeError, RecursionError):
        raise InputError(f'process {pid} answers what is no look at a process') from None
    return before, after


def _await(file: Path, answer: Path, pid: int, deadline: float) -> None:
    failure = answer.with_name(f'{answer.name}.failed')
    while not file.exists():
        if failure.exists():
            reason = ascii(read_regular(failure, _MOST_BYTES).decode(errors='replace'))[:500]
            raise InputError(f'process {pid} could not be looked at: {reason}')
        check_process(pid)
        if time.monotonic() > deadline:
            raise InputError(
                f'process {pid} does not answer within {PATIENCE_S:g} s: it runs C code '
                'that keeps the lock of the interpreter, or is too busy'
            )
        time.sleep(_LOOK_EVERY_S)
