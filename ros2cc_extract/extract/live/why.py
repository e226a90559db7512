"""``why``: where a running process stands, and whether it can go on."""

from __future__ import annotations

import json
import time
from pathlib import Path

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.hang_analysis.samples import look_of
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Explanation, explain
from ros2cc_extract.extract.live.injection import (
    check_process,
    inject,
    injectors,
    private_folder,
    user_to_enter,
)
from ros2cc_extract.files import read_regular

PATIENCE_S = 2.0
_LOOK_EVERY_S = 0.01
_MOST_BYTES = 64_000_000

# In a thread of its own: the one that is entered may hold locks, and goes on at once.
_LINES = """
import _thread
def _look(name='_ros2cc_standing'):
    import importlib.util, os, sys
    path = {path!r}
    try:
        spec = importlib.util.spec_from_file_location(name, {probe!r})
        probe = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(probe)
        probe.look_twice(path + '.new')
        os.replace(path + '.new', path)
    except Exception as error:
        if os.path.isdir(os.path.dirname(path)):
            with open(path + '.failed', 'w') as stream:
                stream.write(repr(error))
_thread.start_new_thread(_look, ())
"""


def explain_process(pid: int) -> Explanation:
    """
    Look twice at a running process, and judge.

    :raises InputError: when there is no such process, it is another user's, has no node, or does
        not answer in time.
    :raises ToolNotFoundError: when nothing here can run code in it.
    """
    check_process(pid)
    user_to_enter(pid, other_user=False)
    ways = injectors()
    # A main thread that stands in C runs nothing for `sys.remote_exec`: that comes last.
    ways = tuple(sorted(ways, key=lambda way: way.name == 'sys.remote_exec'))
    with private_folder() as folder:
        answer, script = folder / 'looks.json', folder / 'look.py'
        probe = Path(__file__).parent / 'hang_analysis' / 'probe.py'
        script.write_text(_LINES.format(path=str(answer), probe=str(probe)), encoding='utf-8')
        inject(pid, script, ways)
        told = _await(answer, pid)
    try:
        before, after = map(look_of, json.loads(told)['looks'])
    except (KeyError, TypeError, ValueError, AttributeError, RecursionError):
        raise InputError(f'process {pid} answers what is no look at a process') from None
    if not after.executors and not after.entities:
        raise InputError(f'process {pid} has no rclpy node')
    return explain(before, after)


def _await(answer: Path, pid: int) -> bytes:
    failure = answer.with_name(f'{answer.name}.failed')
    deadline = time.monotonic() + PATIENCE_S
    while not answer.exists():
        if failure.exists():
            told = ascii(read_regular(failure, _MOST_BYTES).decode(errors='replace'))[:500]
            raise InputError(f'process {pid} could not be looked at: {told}')
        check_process(pid)
        if time.monotonic() > deadline:
            raise InputError(
                f'process {pid} does not answer within {PATIENCE_S:g} s: it runs C code '
                'that keeps the lock of the interpreter, or is too busy'
            )
        time.sleep(_LOOK_EVERY_S)
    return read_regular(answer, _MOST_BYTES)
