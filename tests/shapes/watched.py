"""
Run a node as a program and write down where its threads stand when the time is up.

``python watched.py NODE RECORD SECONDS``, standard library and rclpy only: the node runs in an
environment that holds nothing of ours.
"""

from __future__ import annotations

import atexit
import json
import os
import runpy
import sys
import threading
import time
import traceback
import types
import weakref

from rclpy.task import Task

LOOK_EVERY_S = 0.1
STANDS_AFTER_S = 4.0


class Watch:
    """Which lines of the node threads and coroutines have stood at without a break."""

    def __init__(self, node: str) -> None:
        self.node = node
        self.raised: list[str] = []
        self.tasks: weakref.WeakSet[Task] = weakref.WeakSet()
        self._stands: dict[tuple[int, int], tuple[float, list[tuple[float, int]]]] = {}

    def look(self) -> None:
        """Take down one more time where every frame of the node stands."""
        now = time.monotonic()
        seen = {**self._in_threads(), **self._suspended()}
        for key in [key for key in self._stands if key not in seen]:
            del self._stands[key]
        for key, line in seen.items():
            _, lines = self._stands.setdefault(key, (now, []))
            lines.append((now, line))
            lines[:] = [entry for entry in lines if entry[0] > now - STANDS_AFTER_S]

    def _in_threads(self) -> dict[tuple[int, int], int]:
        seen: dict[tuple[int, int], int] = {}
        for thread, top in sys._current_frames().items():
            frame: types.FrameType | None = top
            while frame is not None:
                if frame.f_code.co_filename == self.node:
                    seen[thread, id(frame)] = frame.f_lineno
                frame = frame.f_back
        return seen

    def _suspended(self) -> dict[tuple[int, int], int]:
        seen: dict[tuple[int, int], int] = {}
        for task in list(self.tasks):
            coroutine = task._handler
            while isinstance(coroutine, types.CoroutineType) and coroutine.cr_frame:
                if coroutine.cr_frame.f_code.co_filename == self.node and not coroutine.cr_running:
                    seen[0, id(coroutine)] = coroutine.cr_frame.f_lineno
                coroutine = coroutine.cr_await
        return seen

    def standing(self) -> list[int]:
        """Lines of frames that have been there for long; of a loop, all that were seen."""
        now = time.monotonic()
        long = (at for since, at in self._stands.values() if now - since > STANDS_AFTER_S)
        return sorted({line for seen in long for _, line in seen})

    def write(self, path: str, is_over: bool) -> None:
        what = {'standing': self.standing(), 'raised': self.raised, 'ended': is_over}
        with open(path, 'w', encoding='utf-8') as record:  # noqa: PTH123
            json.dump(what, record)


def keep_looking(watch: Watch, record: str, seconds: float) -> None:
    """Look until the time is up, then write, and end the process whatever it does."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        watch.look()
        time.sleep(LOOK_EVERY_S)
    watch.write(record, is_over=False)
    sys.stdout.flush()
    os._exit(0)


def note_tasks(tasks: weakref.WeakSet[Task]) -> None:
    """Keep hold of what may be a coroutine: no thread stands where one is suspended."""
    plain = Task.__init__

    def noted(task: Task, *args: object, **kwargs: object) -> None:
        plain(task, *args, **kwargs)
        tasks.add(task)

    Task.__init__ = noted


def main(node: str, record: str, seconds: float) -> None:
    watched = Watch(node)
    note_tasks(watched.tasks)

    def raised(error: BaseException) -> None:
        watched.raised.append(type(error).__name__)
        traceback.print_exception(error)

    threading.excepthook = lambda args: raised(args.exc_value or args.exc_type())
    # Called once the threads that a program waits for are over.
    atexit.register(watched.write, record, is_over=True)
    threading.Thread(target=keep_looking, args=(watched, record, seconds), daemon=True).start()
    sys.argv = [node]
    try:
        runpy.run_path(node, run_name='__main__')
    except BaseException as error:
        raised(error)


if __name__ == '__main__':
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]))
