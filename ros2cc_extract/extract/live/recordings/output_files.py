"""
The files that live recordings become: whole or not at all, and nothing lost that was there before.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TextIO

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.recordings.trace import Trace, write_lines
from ros2cc_extract.extract.live.recordings.trace_event_format import write_chrome
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.yaml.yaml_io import write_specs

# Some seconds of writing, of which a user at a terminal is informed.
MANY_EVENTS = 100_000


def check_output(output: Path) -> None:
    """
    Refuse an output that can only fail, before anything runs.

    :raises InputError: when the folder does not exist or may not be written to.
    """
    folder = output if output.is_dir() else output.parent
    if not folder.is_dir():
        raise InputError('folder does not exist', Place(str(folder)), 'create it first')
    if not os.access(folder, os.W_OK) or (output.is_file() and not os.access(output, os.W_OK)):
        raise InputError(
            'cannot be written: permission denied', Place(str(output)), 'choose another with -o'
        )


def check_file(path: Path) -> None:
    """
    Refuse what can only fail where no folder will do, before anything runs.

    :raises InputError: when it is a directory, or its folder cannot be written to.
    """
    if path.is_dir():
        raise InputError('is a directory', Place(str(path)), 'name a file')
    check_output(path)


def stem_of(output: Path) -> Path:
    """Give the path with which the names of files beside a specification begin."""
    return output.with_name(output.name.removesuffix('.yaml').removesuffix('.spec'))


def write_specs_to(path: Path, specs: Sequence[Spec]) -> None:
    """
    Write specifications.

    :raises InputError: when writing fails; what was there before is kept.
    """
    write_whole(path, lambda stream: stream.write(write_specs(specs)))


def write_traces(traces: Sequence[Trace], path: Path, stderr: TextIO) -> None:
    """
    Write the trace as JSON lines, and for Perfetto beside it (``NAME.perfetto.json``).

    :raises InputError: when writing fails; what was there before is kept.
    """
    count = sum(trace.count for trace in traces)
    if not count:
        print(f'ros2cc-extract: no executor was traced; {path} is not written', file=stderr)
        return
    if count > MANY_EVENTS and stderr.isatty():
        print(f'ros2cc-extract: writing {count:,} events to {path} …', file=stderr)
    write_whole(path, lambda stream: write_lines(traces, stream))
    for_perfetto = path.with_name(f'{path.stem}.perfetto.json')
    write_whole(for_perfetto, lambda stream: write_chrome(traces, stream))


def write_whole(path: Path, write: Callable[[TextIO], object]) -> None:
    """
    Write by way of a temporary file, so that a half-written one never stands there.

    :raises InputError: when writing fails; what was there before is kept.
    """
    temporary = path.with_name(f'{path.name}.new')
    try:
        with temporary.open('w', encoding='utf-8') as stream:
            write(stream)
        temporary.replace(path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        mend = 'what was there before is kept' if path.exists() else ''
        raise InputError(f'cannot be written: {error.strerror}', Place(str(path)), mend) from error
    except BaseException:  # Ctrl-C
        temporary.unlink(missing_ok=True)
        raise
