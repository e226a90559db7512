"""
Run systems with an interpreter that has rclpy, and write down who stands still.

``python -m tests.random_systems.watch OUT FIRST_DOMAIN FOLDER…``: each Python file in a folder is
a process of its own, and each folder has a ROS domain; one JSON line for each system with the
functions that have stood at one place, as ``part_1.tick_0``. Standard library and rclpy only.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import tempfile
import time
from pathlib import Path

from tests.random_waits.watch import LONGEST_S, LONGEST_START_S, run

AT_ONCE = int(os.environ.get('SYSTEMS_AT_ONCE', '8'))


def main() -> None:
    out, first, folders = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
    import rclpy.executors  # noqa: F401  before the fork, so that it is loaded once
    import std_srvs.srv  # noqa: F401

    running: dict[str, dict[int, float]] = {}
    domains: dict[str, int] = {}
    with tempfile.TemporaryDirectory(prefix='ros2cc-systems-') as kept:
        for number, folder in enumerate(folders):
            while len(running) >= AT_ONCE:
                _reap(running, out, kept)
            free = (first + (number + n) % (AT_ONCE * 2) for n in range(AT_ONCE * 2))
            taken = {domains[each] for each in running}
            domains[folder] = next(domain for domain in free if domain not in taken)
            running[folder] = _start(folder, domains[folder], kept)
        while running:
            _reap(running, out, kept)


def _start(folder: str, domain: int, kept: str) -> dict[int, float]:
    os.environ['ROS_DOMAIN_ID'] = str(domain)
    children: dict[int, float] = {}
    files = sorted(Path(folder).glob('*.py'))
    for file in files:
        child = os.fork()
        if child == 0:
            run(str(file), f'{kept}/{Path(folder).parent.name}', together=len(files))
            os._exit(0)
        children[child] = time.monotonic()
    return children


def _reap(running: dict[str, dict[int, float]], out: str, kept: str) -> None:
    time.sleep(0.1)
    for folder, children in list(running.items()):
        for child, begun in list(children.items()):
            if time.monotonic() - begun > 2 * (LONGEST_START_S + LONGEST_S):
                os.kill(child, signal.SIGKILL)
            if os.waitpid(child, os.WNOHANG)[0]:
                del children[child]
        if not children:
            del running[folder]
            _tell(folder, out, kept)


def _tell(folder: str, out: str, kept: str) -> None:
    """A system of which one process said nothing was not run."""
    said = Path(kept) / Path(folder).parent.name
    text = said.read_text(encoding='utf-8') if said.exists() else ''
    rows = [json.loads(line) for line in text.splitlines()]
    if len(rows) < len(list(Path(folder).glob('*.py'))):
        return
    stuck = sorted(f'{Path(row["file"]).stem}.{name}' for row in rows for name in row['stuck'])
    with Path(out).open('a', encoding='utf-8') as stream:
        stream.write(json.dumps({'folder': folder, 'stuck': stuck}) + '\n')


if __name__ == '__main__':
    main()
