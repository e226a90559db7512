"""
``attach``: the specification of a process that already runs, without having started it.

A few lines run in one of its threads, which write a recording and leave nothing behind;
``injection.py`` is the way in.
"""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TextIO

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.injection import (
    Injector,
    check_process,
    inject,
    injectors,
    private_folder,
    user_to_enter,
)
from ros2cc_extract.extract.live.recordings.collect import specs_of
from ros2cc_extract.extract.live.recordings.output_files import check_file, write_specs_to
from ros2cc_extract.extract.live.recordings.recording import read_recording
from ros2cc_extract.extract.live.run import report_losses
from ros2cc_extract.files import read_regular

EXIT_CLEAN, EXIT_ERROR = 0, 2
# The main thread runs our lines as soon as it is back from C; an executor wakes at every event.
PATIENCE_S = 15.0
MOST_REPORTED_BYTES = 10_000
_LOOK_EVERY_S = 0.05


_LINES = """
import importlib, importlib.util, os, sys
def _record(name='_ros2cc_attached'):
    folder, path = {folder!r}, {path!r}
    try:
        spec = importlib.util.spec_from_file_location(
            name, os.path.join(folder, '__init__.py'), submodule_search_locations=[folder])
        sys.modules[name] = importlib.util.module_from_spec(spec)
        importlib.import_module(name + '.hook.inspection').record_process(path + '.new')
        os.replace(path + '.new', path)
    except Exception as error:
        with open(path + '.failed', 'w') as stream:
            stream.write(repr(error))
    finally:
        for loaded in [each for each in sys.modules if each.partition('.')[0] == name]:
            del sys.modules[loaded]
_record()
del _record
"""


def attach_process(pid: int, output: Path, stderr: TextIO, *, other_user: bool = False) -> int:
    """
    Write the specification of a running process.

    :param other_user: enter a process of another user too, which root may.
    :return: 0; 2 when the process holds no node in an rclpy executor.
    :raises InputError: when there is no such process, it is another user's, or does not answer.
    :raises ToolNotFoundError: when nothing here can run code in it.
    """
    check_file(output)
    check_process(pid)
    user = user_to_enter(pid, other_user=other_user)
    ways = injectors()
    with private_folder() as folder:
        recording = read_recording(_record(pid, user, folder, ways), Path.cwd())
    report_losses([recording], stderr)
    specs = specs_of(recording)
    if not specs:
        print(f'ros2cc-extract: process {pid} has no node in an rclpy executor', file=stderr)
        return EXIT_ERROR
    write_specs_to(output, specs)
    return EXIT_CLEAN


def _record(pid: int, user: int, folder: Path, ways: Sequence[Injector]) -> Path:
    recording = folder / f'{pid}.json'
    script = folder / 'record.py'
    package = str(Path(__file__).resolve().parent)
    script.write_text(_LINES.format(folder=package, path=str(recording)), encoding='utf-8')
    if user != os.geteuid():
        # From here on it is theirs: they may write there, and nothing there is followed by us.
        script.chmod(0o644)
        os.chown(folder, user, -1)
    inject(pid, script, ways)
    return _await(recording, pid)


def _await(recording: Path, pid: int) -> Path:
    failure = recording.with_name(f'{recording.name}.failed')
    deadline = time.monotonic() + PATIENCE_S
    while not recording.exists():
        if failure.exists():
            raise InputError(f'process {pid} could not be recorded: {_shown_by(failure)}')
        if time.monotonic() > deadline:
            raise InputError(
                f'process {pid} does not answer: its main thread runs no Python',
                None,
                'it is blocked in C, or no Python process',
            )
        time.sleep(_LOOK_EVERY_S)
    return recording


def _shown_by(failure: Path) -> str:
    try:
        return ascii(
            read_regular(failure, MOST_REPORTED_BYTES, follow=False).decode(errors='replace')
        )
    except OSError as error:
        return f'{error.strerror}'
