"""
Read what the flight recorder of a watched process has left, and write it for Perfetto.

The copies that it made at a hang, an exception or a signal; and of a process that has not ended,
or was killed, the last steps as they lie there.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TextIO

from ros2cc_extract.extract.live.hook.flight import COPY, TURNS
from ros2cc_extract.extract.live.recorder.events import RAW_SUFFIX, rows
from ros2cc_extract.extract.live.recordings.output_files import stem_of, write_whole
from ros2cc_extract.extract.live.recordings.recording import Recording
from ros2cc_extract.extract.live.recordings.trace import Trace, read_trace
from ros2cc_extract.extract.live.recordings.trace_event_format import write_chrome
from ros2cc_extract.files import read_named

# Twice half a minute of as many steps as the hook can keep.
MOST_BYTES = 256 * 1024 * 1024
LAST = 'last'


def write_flight_records(recordings: Sequence[Recording], output: Path, stderr: TextIO) -> None:
    """
    Write each flight record for Perfetto beside ``output``, and say where.

    :param output: the specification, or the folder of specifications.
    :raises InputError: when reading or writing fails.
    """
    with tempfile.TemporaryDirectory(prefix='ros2cc-flight-') as scratch:
        for recording in recordings:
            for why, trace in _flights(recording, Path(scratch)):
                name = f'{recording.pid}.{why}.perfetto.json'
                path = output / name if output.is_dir() else Path(f'{stem_of(output)}.{name}')
                write_whole(path, partial(write_chrome, (trace,)))
                print(f'ros2cc-extract: {path} shows {_shown(trace, why)}', file=stderr)


def _shown(trace: Trace, why: str) -> str:
    clocks = [event.clock_ns for event in trace.events()]
    until = 'until now' if why == LAST else f'until the {why.rpartition("-")[0]}'
    return f'the last {(clocks[-1] - clocks[0]) / 1e9:.0f} s {until}; open it in ui.perfetto.dev'


def _flights(recording: Recording, scratch: Path) -> Iterator[tuple[str, Trace]]:
    stem = Path(recording.file.removesuffix('.json'))
    copies = list(stem.parent.glob(f'{stem.name}{COPY}*{RAW_SUFFIX}'))
    for copy in sorted(copies, key=lambda path: path.stat().st_mtime_ns):
        trace = read_trace(recording, copy)
        if trace is not None and trace.count:
            yield copy.name.removeprefix(stem.name + COPY).removesuffix(RAW_SUFFIX), trace
    if not recording.ended:
        last = scratch / f'{stem.name}{COPY}{LAST}{RAW_SUFFIX}'
        last.write_bytes(_joined(stem))
        trace = read_trace(recording, last)
        if trace is not None and trace.count:
            yield LAST, trace


def _joined(stem: Path) -> bytes:
    """Put the two files that take turns one after the other, the older first."""
    paths = (Path(f'{stem}{turn}') for turn in TURNS)
    parts = [read_named(path, MOST_BYTES) for path in paths if path.exists()]
    parts.sort(key=_first_clock)
    return b''.join(parts)


def _first_clock(raw: bytes) -> int:
    return min((fields[0] for fields, name in rows(raw) if not name), default=0)
