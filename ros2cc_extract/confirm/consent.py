"""Start nothing before the user has agreed."""

from __future__ import annotations

import hashlib
import sys
from pathlib import Path
from typing import TextIO

from ros2cc_extract.cache_file import default_cache_folder, who_can_change
from ros2cc_extract.errors import InputError
from ros2cc_extract.source_locations import Place

_FILE = 'may-be-started'
_MOST_BYTES = 1_000_000


def ask_to_start(entry: str, python: str, stderr: TextIO, *, yes: bool) -> None:
    """
    Ask before a program is started for the first time; the answer is kept for this file.

    :raises InputError: when the answer is no, or no user can be asked.
    """
    path = Path(entry).resolve()
    _ask(str(path), f'{path} with {python}', entry, stderr, yes=yes)


def ask_to_run(command: str, stderr: TextIO, *, yes: bool) -> None:
    """
    Ask before a command is run for the first time here; the answer is kept for this command.

    :raises InputError: as ``ask_to_start``.
    """
    _ask(f'{Path.cwd()}: {command}', command, command, stderr, yes=yes)


def _ask(mark: str, what_is_started: str, entry: str, stderr: TextIO, *, yes: bool) -> None:
    if yes or _mark(mark) in _marks():
        return
    if not sys.stdin.isatty():
        what = 'is not started: nobody was asked, as this is no terminal'
        raise InputError(what, Place(entry), 'add --yes; its code then runs as if you started it')
    question = f'start {what_is_started}, as if you started it, in a ROS domain of its own?'
    print(f'{question} [y/N] ', end='', file=stderr, flush=True)
    if sys.stdin.readline().strip().lower() not in ('y', 'yes'):
        raise InputError('is not started', Place(entry))
    _keep(mark)


def _mark(text: str) -> str:
    return hashlib.sha256(text.encode('utf-8', 'surrogateescape')).hexdigest()


def _marks() -> frozenset[str]:
    """What was said before, unless another user could have written it."""
    folder = default_cache_folder()
    try:
        if folder is None or who_can_change(folder) is not None:
            return frozenset()
        with (folder / _FILE).open(encoding='ascii') as stream:
            return frozenset(stream.read(_MOST_BYTES).split())
    except (OSError, ValueError):
        return frozenset()


def _keep(text: str) -> None:
    folder = default_cache_folder()
    if folder is None:
        return
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        with (folder / _FILE).open('a', encoding='ascii') as stream:
            stream.write(f'{_mark(text)}\n')
    except OSError:
        return  # it will be asked again
