"""
One command after the other in one process: to start it takes longer than most of them.

Reads a line of JSON for each, answers with one: how it ended, what it said, what it cost and what
it left. Whether it ends at all is for the other side to see.
"""

from __future__ import annotations

import faulthandler
import io
import json
import os
import resource
import sys
import threading
import traceback
from pathlib import Path

from ros2cc_extract.cli.main import main

MOST_BYTES = 4_000_000_000
RESET_PEAK = '5'
"""See proc(5), ``/proc/PID/clear_refs``."""


def run(arguments: list[str]) -> dict[str, object]:
    out, err = (io.TextIOWrapper(io.BytesIO(), 'utf-8', 'backslashreplace') for _ in range(2))
    Path('/proc/self/clear_refs').write_text(RESET_PEAK)
    before, begun, crash = held(), os.times(), ''
    status: object = None
    try:
        status = main(arguments, out, err)
    except BaseException:
        crash = traceback.format_exc()
    ended = os.times()
    out.seek(0)
    err.seek(0)
    return {
        'status': status,
        'out': out.read(),
        'err': err.read(),
        'crash': crash,
        'seconds': sum(ended[:4]) - sum(begun[:4]),
        'megabytes': peak_megabytes(),
        'left': [what for what, now in held().items() if now > before[what]],
    }


def peak_megabytes() -> float:
    for line in Path('/proc/self/status').read_text().splitlines():
        if line.startswith('VmHWM:'):
            return int(line.split()[1]) / 1024
    return 0.0


def held() -> dict[str, int]:
    """What a command may leave behind in its process."""
    children = Path(f'/proc/self/task/{os.getpid()}/children').read_text().split()
    # libffi 3.5, which ctypes uses, keeps its own file open for static trampolines: src/tramp.c.
    files = [each.readlink() for each in Path('/proc/self/fd').iterdir() if each.is_symlink()]
    return {
        'child': len(children),
        'descriptor': sum(not each.name.startswith('libffi.so') for each in files),
        'thread': threading.active_count(),
    }


def serve() -> None:
    faulthandler.enable()
    resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
    answers = os.fdopen(os.dup(1), 'w')
    os.dup2(2, 1)
    for line in sys.stdin:
        asked = json.loads(line)
        os.chdir(asked['folder'])
        told = run(asked['arguments'])
        os.chdir('/')
        print(json.dumps(told), file=answers, flush=True)


if __name__ == '__main__':
    serve()
