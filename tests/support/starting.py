"""
Starts the command as a user does, thousands of times.

Python itself starts it where the start is what counts, and once for each subcommand. Else a
process that has imported it forks one, see ``tests.support.ready``: a fifth of the time.
"""

from __future__ import annotations

import atexit
import json
import os
import selectors
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
TOOL = (sys.executable, '-m', 'ros2cc_extract.cli.main')
OF_THE_START = ('PYTHON', 'LC_', 'LANG', 'LD_', 'MALLOC_')
"""Variables that are read before the first line of the command."""
PATIENCE_S = 120
"""Far more than any of them needs on a busy machine: who is not done by then hangs."""
_PIPE_HOLDS = 65_536
_started: set[str] = set()


def run_command(
    arguments: Sequence[object],
    *,
    cwd: Path,
    env: Mapping[str, str],
    prefix: Sequence[str] = (),
    given: bytes = b'',
) -> subprocess.CompletedProcess[bytes]:
    """Run the command to its end."""
    told = [*map(str, arguments)]
    subcommand = told[0] if told else ''
    is_first = subcommand.isalpha() and subcommand not in _started
    _started.add(subcommand)
    if is_first or prefix or _of_the_start(env) != _of_the_start(os.environ):
        return subprocess.run(
            [*prefix, *TOOL, *told],
            cwd=cwd,
            env=env,
            input=given,
            capture_output=True,
            timeout=PATIENCE_S,
            check=False,
        )
    return _ready().run(told, cwd, env, given)


def _of_the_start(env: Mapping[str, str]) -> dict[str, str]:
    return {name: value for name, value in env.items() if name.startswith(OF_THE_START)}


@cache
def _ready() -> _Ready:
    return _Ready()


class _Ready:
    """The process that forks, from the first request to the end of the tests."""

    def __init__(self) -> None:
        self._line, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            number = theirs.fileno()
            self._process = subprocess.Popen(
                [sys.executable, '-m', 'tests.support.ready', str(number)],
                cwd=ROOT,
                # Pipes, as what it takes on: a stream remembers what it was opened on.
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                pass_fds=(number,),
            )
        self._line.settimeout(PATIENCE_S)
        atexit.register(self._end)

    def run(
        self, arguments: Sequence[str], cwd: Path, env: Mapping[str, str], given: bytes
    ) -> subprocess.CompletedProcess[bytes]:
        assert len(given) <= _PIPE_HOLDS
        (read, write), (out, their_out), (err, their_err) = (os.pipe() for _ in range(3))
        os.write(write, given)
        os.close(write)
        theirs = (read, their_out, their_err)
        request = {'arguments': arguments, 'cwd': str(cwd), 'env': dict(env)}
        socket.send_fds(self._line, [json.dumps(request).encode()], theirs)
        for stream in theirs:
            os.close(stream)
        pid = int(self._line.recv(100))
        try:
            streams = _read_to_the_end(out, err)
        except subprocess.TimeoutExpired:
            os.kill(pid, signal.SIGKILL)
            raise
        finally:
            status = int(self._line.recv(100))
        return subprocess.CompletedProcess([*TOOL, *arguments], status, *streams)

    def _end(self) -> None:
        self._line.close()
        self._process.communicate()


def _read_to_the_end(*streams: int) -> list[bytes]:
    read: dict[int, bytes] = dict.fromkeys(streams, b'')
    give_up = time.monotonic() + PATIENCE_S
    with selectors.DefaultSelector() as selector:
        for stream in streams:
            selector.register(stream, selectors.EVENT_READ)
        while selector.get_map():
            ready = selector.select(give_up - time.monotonic())
            if not ready:
                raise subprocess.TimeoutExpired(TOOL, PATIENCE_S)
            for key, _ in ready:
                more = os.read(key.fd, _PIPE_HOLDS)
                read[key.fd] += more
                if not more:
                    selector.unregister(key.fd)
                    os.close(key.fd)
    return [read[stream] for stream in streams]
