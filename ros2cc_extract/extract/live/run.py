"""``run``: start any command with the hook, and write what its processes held."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TextIO

from ros2cc_extract.errors import InputError, Ros2ccError
from ros2cc_extract.extract.live.child_process import deaf_to_ctrl_c, end_alike, run_child
from ros2cc_extract.extract.live.environment import hooked_environment
from ros2cc_extract.extract.live.hook.watch import FILE_SUFFIX
from ros2cc_extract.extract.live.recordings.collect import specs_of
from ros2cc_extract.extract.live.recordings.flight_records import write_flight_records
from ros2cc_extract.extract.live.recordings.output_files import (
    check_file,
    check_output,
    stem_of,
    write_specs_to,
    write_traces,
    write_whole,
)
from ros2cc_extract.extract.live.recordings.recording import Recording, read_recording
from ros2cc_extract.extract.live.recordings.trace import Trace, read_trace
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Spec

DEFAULT_OUTPUT = Path('live.spec.yaml')
# In a folder of specifications; else it is named after the one.
WHY = 'why.txt'
EXIT_ERROR = 2
EXIT_INTERRUPTED = 130
Finish = Callable[[tuple[Spec, ...]], int]


@dataclass(frozen=True)
class Recorded:
    """What came of a run: the command's status (negative: a signal), and its processes."""

    status: int
    recordings: tuple[Recording, ...]
    traces: tuple[Trace, ...] = ()

    @property
    def specs(self) -> tuple[Spec, ...]:
        return tuple(spec for recording in self.recordings for spec in specs_of(recording))


def run_command(
    command: Sequence[str],
    output: Path,
    stderr: TextIO,
    *,
    trace: Path | None = None,
    limit_s: float | None = None,
    environment: Mapping[str, str] = os.environ,
    finish: Finish | None = None,
) -> int:
    """
    Run ``command`` with the hook and write the specification of all its processes.

    A process that a signal ended ends us by the same signal, after the output is written.

    :param output: a file, or an existing directory, which gets a file for each process.
    :param trace: file for the execution trace; another for Perfetto is written beside it.
    :param limit_s: explain where no callback has ended for so long; written beside the output.
    :param finish: called with all units when everything is written; its status is given back
        where the command itself ended well.
    :return: the command's exit status; 2 if that is 0 and the output could not be written.
    :raises InputError: when it is plain before the start that ``output`` cannot be written.
    :raises ToolNotFoundError: when the command cannot be started.
    """
    check_output(output)
    if trace is not None:
        check_file(trace)
    with tempfile.TemporaryDirectory(prefix='ros2cc-live-') as folder:
        traced = trace is not None
        recorded = record(
            command, environment, stderr, Path(folder), traced=traced, limit_s=limit_s
        )
        try:
            with deaf_to_ctrl_c():
                report_losses(recorded.recordings, stderr)
                write_output(recorded, output, stderr)
                write_explanations(Path(folder), output, stderr)
                write_flight_records(recorded.recordings, output, stderr)
            if trace is not None:
                write_traces(recorded.traces, trace, stderr)
        except Ros2ccError as error:
            print(f'ros2cc-extract: {error}', file=stderr)
            finished = EXIT_ERROR
        except KeyboardInterrupt:
            print(f'ros2cc-extract: interrupted; {trace} is not whole', file=stderr)
            finished = EXIT_INTERRUPTED
        else:
            finished = finish(recorded.specs) if finish else 0
    return end_alike(recorded.status) or finished


def collect_directory(
    directory: Path, output: Path, stderr: TextIO, *, trace: Path | None = None
) -> int:
    """
    Write the specification of all processes that recorded themselves into ``directory``.

    For processes that were hooked by environment variables alone; they may still run.

    :return: 0; 2 when there is nothing in it.
    :raises InputError: when the directory does not exist or ``output`` cannot be written.
    """
    if not directory.is_dir():
        raise InputError('is no directory', Place(str(directory)), 'name the one given to env -o')
    check_output(output)
    if trace is not None:
        check_file(trace)
    recordings = tuple(read_directory(directory, stderr))
    if not recordings:
        mend = f'start the nodes after: eval "$(ros2cc-extract env -o {directory})"'
        what = 'holds no recording of a process'
        print(f'ros2cc-extract: {directory}: {what}; {mend}', file=stderr)
        return EXIT_ERROR
    report_losses(recordings, stderr)
    recorded = Recorded(0, recordings)
    write_output(recorded, output, stderr)
    write_flight_records(recordings, output, stderr)
    if trace is not None:
        write_traces(tuple(filter(None, map(read_trace, recordings))), trace, stderr)
    return 0 if recorded.specs else EXIT_ERROR


def record(
    command: Sequence[str],
    environment: Mapping[str, str],
    stderr: TextIO,
    folder: Path,
    *,
    traced: bool = False,
    limit_s: float | None = None,
) -> Recorded:
    """Run ``command`` with the hook, and read what it has recorded into ``folder``."""
    hooked = hooked_environment(environment, folder, traced=traced, limit_s=limit_s)
    status = run_child(command, hooked)
    with deaf_to_ctrl_c():
        return read_recorded(status, folder, stderr, traced=traced)


def read_recorded(status: int, folder: Path, stderr: TextIO, *, traced: bool) -> Recorded:
    """
    Read what a command has recorded; say what could not be read.

    :param folder: of the recordings; traces are read from there whenever they are asked for.
    """
    recordings = read_directory(folder, stderr)
    traces = (read_trace(recording) for recording in recordings) if traced else ()
    return Recorded(status, tuple(recordings), tuple(filter(None, traces)))


def read_directory(directory: Path, stderr: TextIO) -> list[Recording]:
    """Read the recordings of a directory in the order of their making, but for damaged ones."""
    recordings = []
    for path in sorted(directory.glob('*.json'), key=lambda path: path.stem.rpartition('-')[2]):
        try:
            recordings.append(read_recording(path, Path.cwd()))
        except InputError as error:
            print(f'ros2cc-extract: {error}', file=stderr)
    return recordings


def write_output(recorded: Recorded, output: Path, stderr: TextIO) -> None:
    """
    Write one file, or into a directory one file for each process.

    :raises InputError: when writing fails; what was there before is kept.
    """
    if not recorded.specs:
        print(
            'ros2cc-extract: no recorded process has put a node into an rclpy executor; '
            f'{output} is not written',
            file=stderr,
        )
    elif output.is_dir():
        for recording in recorded.recordings:
            specs = specs_of(recording)
            if specs:
                write_specs_to(output / f'{specs[0].name}-{recording.pid}.spec.yaml', specs)
    else:
        write_specs_to(output, recorded.specs)


def write_explanations(folder: Path, output: Path, stderr: TextIO) -> None:
    """
    Write why callbacks did not end, where the hook has noticed that, beside the output.

    :raises InputError: when writing fails.
    """
    texts = [path.read_text(encoding='utf-8') for path in sorted(folder.glob(f'*{FILE_SUFFIX}'))]
    if texts:
        path = output / WHY if output.is_dir() else Path(f'{stem_of(output)}{FILE_SUFFIX}')
        write_whole(path, lambda stream: stream.write(''.join(texts)))
        print(f'ros2cc-extract: {path} says why callbacks did not end', file=stderr)


def report_losses(recordings: Sequence[Recording], stderr: TextIO) -> None:
    """Say what the hook failed to record."""
    for recording in recordings:
        if recording.losses:
            last = recording.last_losses[-1] if recording.last_losses else 'unknown'
            print(
                f'ros2cc-extract: process {recording.pid}: the hook failed '
                f'{recording.losses} times (last: {last}); the node was not touched, but its '
                'specification may lack something',
                file=stderr,
            )
