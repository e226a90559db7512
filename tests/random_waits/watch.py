"""
Run programs with an interpreter that has rclpy, and write down who stands still.

``watch.py OUT FILE…``: each program in a forked child; one JSON line for each with the names of
the functions that have stood at one place for ``STILL_S``. Standard library and rclpy only.
"""

from __future__ import annotations

import contextlib
import gc
import json
import os
import random
import runpy
import signal
import sys
import threading
import time
import types
from pathlib import Path

STILL_S = 3.0
LOOKS_S = 0.25
LONGEST_S = 7.0
LONGEST_START_S = 20.0
AT_ONCE = 10
_OUTSIDE = ('<module>', 'main', '__init__')
LONGEST_PAUSE_S = 0.3
PAUSES = 0.3


def standing(file: str) -> dict[int, tuple[object, int, str]]:
    """Every function of the program that is active: its frame, where it stands, its name."""
    found: dict[int, tuple[object, int, str]] = {}
    for frame in sys._current_frames().values():
        outermost: types.FrameType | None = None
        at: types.FrameType | None = frame
        while at is not None:
            is_ours = at.f_code.co_filename == file and at.f_code.co_name not in _OUTSIDE
            outermost = at if is_ours else outermost
            at = at.f_back
        if outermost is not None:
            found[id(outermost)] = (outermost, outermost.f_lasti, outermost.f_code.co_name)
    for thing in gc.get_objects():
        is_coroutine = isinstance(thing, types.CoroutineType)
        if is_coroutine and thing.cr_code.co_filename == file and thing.cr_frame is not None:
            found[id(thing)] = (thing, thing.cr_frame.f_lasti, thing.cr_code.co_name)
    return found


def wait_for_spin(latest: float) -> None:
    """A busy machine takes long to make a node; the time counts from when it is served."""
    while time.monotonic() < latest:
        for frame in sys._current_frames().values():
            at: types.FrameType | None = frame
            while at is not None:
                if at.f_code.co_name == 'spin':
                    return
                at = at.f_back
        time.sleep(0.05)


def watch(file: str, out: str, together: int = 1) -> None:
    """
    Look again and again; end the process when the time is up.

    :param together: so many processes ask each other, and write to ``out``: none looks before the
        last is served, and none ends before the last has looked: what waits for one that is not
        served yet, or has ended, would stand still.
    """
    since: dict[int, tuple[tuple[object, int, str], float]] = {}
    latest = time.monotonic() + LONGEST_START_S
    wait_for_spin(latest)
    if together > 1:
        write_line(spun(out), file)
        wait_for_all(spun(out), together, latest)
    begun = time.monotonic()
    while time.monotonic() - begun < LONGEST_S:
        time.sleep(LOOKS_S)
        now = time.monotonic()
        seen = standing(file)
        since = {
            key: since[key] if key in since and since[key][0] == one else (one, now)
            for key, one in seen.items()
        }
    now = time.monotonic()
    stuck = sorted({one[2] for one, start in since.values() if now - start >= STILL_S})
    write_line(Path(out), {'file': file, 'stuck': stuck})
    wait_for_all(Path(out), together, time.monotonic() + LONGEST_START_S + LONGEST_S)
    os._exit(0)


def spun(out: str) -> Path:
    """Where the processes of a system say that they are served."""
    return Path(f'{out}.spun')


def write_line(path: Path, row: object) -> None:
    with path.open('a', encoding='utf-8') as stream:
        stream.write(json.dumps(row) + '\n')


def wait_for_all(path: Path, together: int, latest: float) -> None:
    """Wait until so many have written their line."""
    while time.monotonic() < latest:
        if len(path.read_text(encoding='utf-8').splitlines()) >= together:
            return
        time.sleep(LOOKS_S)


def disturb(file: str) -> None:
    """Let every thread pause now and then at lines of the program, for as long as chance says."""
    chance = random.Random(file)

    def at_line(frame: types.FrameType, event: str, _: object) -> object:
        if frame.f_code.co_filename != file or frame.f_code.co_name in _OUTSIDE:
            return None
        if event == 'line' and chance.random() < PAUSES:
            time.sleep(chance.random() * LONGEST_PAUSE_S)
        return at_line

    threading.settrace(at_line)
    sys.settrace(at_line)


def run(file: str, out: str, together: int = 1) -> None:
    """Be the child: the program in the main thread, the watch in another."""
    threading.Thread(target=watch, args=(file, out, together), daemon=True).start()
    if os.environ.get('WATCH_DISTURBS'):
        disturb(file)
    with contextlib.suppress(BaseException), Path(os.devnull).open('w') as nothing:
        os.dup2(nothing.fileno(), 2)
        runpy.run_path(file, run_name='__main__')
    time.sleep(
        2 * (LONGEST_START_S + LONGEST_S)
    )  # the program has ended, with an exception or without


def main() -> None:
    out, files = sys.argv[1], sys.argv[2:]
    import rclpy.executors  # noqa: F401  before the fork, so that it is loaded once
    import std_msgs.msg  # noqa: F401
    import std_srvs.srv  # noqa: F401

    children: dict[int, float] = {}
    for file in files:
        while len(children) >= AT_ONCE:
            _reap(children)
        child = os.fork()
        if child == 0:
            run(file, out)
            os._exit(0)
        children[child] = time.monotonic()
    while children:
        _reap(children)


def _reap(children: dict[int, float]) -> None:
    time.sleep(0.1)
    for child, begun in list(children.items()):
        if time.monotonic() - begun > 2 * LONGEST_START_S:
            os.kill(child, signal.SIGKILL)
        if os.waitpid(child, os.WNOHANG)[0]:
            del children[child]


if __name__ == '__main__':
    main()
