"""
Run many small programs with rclpy at once, each in a fork of one process that has imported it.

Used as ``python forked.py DOMAIN,DOMAIN…`` with a JSON list of programs, see ``Run``, on stdin;
writes one JSON object, name to lines of output, to stdout. A program says ``asks`` before it does
what is to be seen. Programs do not meet: at any time each is alone in its domain, and it is alone
in its name space forever.
"""

from __future__ import annotations

import ctypes
import io
import json
import os
import re
import signal
import sys
import threading
import time
import traceback
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from selectors import EVENT_READ, DefaultSelector
from typing import Any

# What every program needs, imported once for all.
import std_msgs.msg  # noqa: F401
import std_srvs.srv  # noqa: F401
import test_msgs.action  # noqa: F401

START_S = 120.0


class Run:
    """
    A program that runs: lines of its output, and until when it may live.

    It is killed ``afterwards_s`` after it has said all that is awaited of it, in that order, or
    ``patience_s`` after it has asked.

    :param awaited: patterns of whole lines; with none of them it lives for all of its time.
    """

    def __init__(
        self,
        domain: str,
        *,
        name: str,
        path: str,
        text: str,
        patience_s: float,
        awaited: Sequence[str] = (),
        afterwards_s: float = 0.0,
    ) -> None:
        self.name, self.domain = name, domain
        self._patience_s, self._afterwards_s = patience_s, afterwards_s
        self._awaited = [re.compile(pattern) for pattern in awaited]
        self._asked = False
        self._begun_line = b''
        self.lines: list[str] = []
        self.deadline = time.monotonic() + START_S
        self.reader, writer = os.pipe()
        self.pid = os.fork()
        if self.pid == 0:
            os.setsid()
            # It ends with its parent, however that ends: <linux/prctl.h>, PR_SET_PDEATHSIG.
            ctypes.CDLL(None).prctl(1, signal.SIGKILL)
            os.dup2(writer, 1)
            os.dup2(writer, 2)
            os.environ['ROS_DOMAIN_ID'] = domain
            _become(name, path, text)
        os.close(writer)

    def read(self) -> None:
        """Read what is there; the program lives on for as long as what it said asks for."""
        *whole, self._begun_line = (self._begun_line + os.read(self.reader, 65536)).split(b'\n')
        for line in whole:
            self._hear(line.decode(errors='replace'))

    def _hear(self, line: str) -> None:
        self.lines.append(line)
        if line == 'asks' and not self._asked:
            self._asked = True
            self.deadline = time.monotonic() + self._patience_s
        if self._awaited and self._awaited[0].fullmatch(line):
            del self._awaited[0]
            if not self._awaited:
                self.deadline = time.monotonic() + self._afterwards_s

    def end(self) -> None:
        os.killpg(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        os.close(self.reader)


class Lines(io.TextIOBase):
    """Standard output of a program whose threads do not break into each other's lines."""

    def __init__(self) -> None:
        self._begun = threading.local()

    def write(self, text: str) -> int:
        whole, newline, rest = (getattr(self._begun, 'text', '') + text).rpartition('\n')
        self._begun.text = rest
        if newline:
            os.write(1, f'{whole}\n'.encode())
        return len(text)


def _become(name: str, path: str, text: str) -> None:
    """Be the program, in the child, and nothing else ever after."""
    sys.argv = [path, '--ros-args', '-r', f'__ns:=/{name}']
    sys.path.insert(0, str(Path(path).parent))
    sys.stdout = Lines()
    try:
        exec(compile(text, path, 'exec'), {'__name__': '__main__', '__file__': path})
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(0)


def run_all(
    programs: Sequence[Mapping[str, Any]], domains: list[str]
) -> Iterator[tuple[str, list[str]]]:
    """Yield what each program has said, as they come to their ends."""
    waiting, free = list(reversed(programs)), list(domains)
    runs: dict[int, Run] = {}
    with DefaultSelector() as selector:
        while waiting or runs:
            while waiting and free:
                run = Run(free.pop(), **waiting.pop())
                runs[run.reader] = run
                selector.register(run.reader, EVENT_READ)
            soonest = min(run.deadline for run in runs.values())
            for key, _ in selector.select(max(0.0, soonest - time.monotonic())):
                runs[key.fd].read()
            for run in [run for run in runs.values() if run.deadline <= time.monotonic()]:
                selector.unregister(run.reader)
                del runs[run.reader]
                run.end()
                free.append(run.domain)
                yield run.name, run.lines


if __name__ == '__main__':
    found = run_all(json.load(sys.stdin), sys.argv[1].split(','))
    json.dump(dict(found), sys.stdout)
