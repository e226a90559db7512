"""
A process that has imported the command: it forks one that runs it whenever it is asked to.

What runs is a process of its own, with streams, a folder and an environment of its own. Only the
imports are shared, which are most of what a start costs. Run as ``python -m tests.support.ready
NUMBER``, the number of a socket; ``tests.support.starting`` is the other end.
"""

from __future__ import annotations

import importlib
import json
import os
import pkgutil
import socket
import sys

import ros2cc_extract
from ros2cc_extract.cli import main

LARGEST_REQUEST = 1 << 20
ELSEWHERE = ('ros2cc_extract.extract.live', 'ros2cc_extract.live', 'ros2cc_extract.ros')
"""Loaded by rclpy's interpreters, by ROS and by pytest; of no use in a command."""


def import_all() -> None:
    """Load what any command may need, so that no fork has to."""
    for module in pkgutil.walk_packages(ros2cc_extract.__path__, 'ros2cc_extract.'):
        if not module.name.startswith(ELSEWHERE) and not module.name.endswith('__main__'):
            importlib.import_module(module.name)
    for name in ('jinja2', 'lark', 'rich.console', 'rich.table', 'rich.progress', 'yaml'):
        importlib.import_module(name)


def serve(line: socket.socket) -> bool:
    """Fork for each request; gives true in the process that is to run the command."""
    while True:
        told, streams, _, _ = socket.recv_fds(line, LARGEST_REQUEST, 3)
        if not told:
            return False
        pid = os.fork()
        if not pid:
            line.close()
            take_on(json.loads(told), streams)
            return True
        for stream in streams:
            os.close(stream)
        line.send(str(pid).encode())
        _, status = os.waitpid(pid, 0)
        line.send(str(os.waitstatus_to_exitcode(status)).encode())


def take_on(request: dict[str, object], streams: list[int]) -> None:
    """Become what Python would have started."""
    arguments, environment, folder = (request[name] for name in ('arguments', 'env', 'cwd'))
    assert isinstance(arguments, list) and isinstance(environment, dict)
    assert isinstance(folder, str)
    for number, stream in enumerate(streams):
        os.dup2(stream, number)
        os.close(stream)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    sys.path[0] = folder  # as `python -m` has it
    sys.argv = [str(main.__file__), *arguments]


if __name__ == '__main__':
    import_all()
    if serve(socket.socket(fileno=int(sys.argv[1]))):
        main.entry_point()
