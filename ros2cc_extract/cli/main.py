"""The command line: finds the subcommand, loads only that one, and turns errors into one line."""

from __future__ import annotations

import argparse
import gc
import importlib
import os
import signal
import sys
import traceback
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Protocol, TextIO, cast

from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_ERROR, EXIT_INTERRUPTED
from ros2cc_extract.cli.shared.native_parts import report_missing_parts
from ros2cc_extract.cli.shared.streams import as_utf_8, silence, with_streams
from ros2cc_extract.cli.shared.termination import (
    Termination,
    forget_interrupt,
    termination_as_interrupt,
)
from ros2cc_extract.errors import InputError, Ros2ccError, did_you_mean
from ros2cc_extract.source_locations import Place
from ros2cc_extract.text_escaping import Shown, raw
from ros2cc_extract.version import PROGRAM, __version__

DEFAULT_COMMAND = 'check'
COMMANDS = {
    'check': 'find what can go wrong (the default: `ros2cc-extract my_node.py`)',
    'fleet': 'check many repositories, with one result each',
    'spec': 'print the YAML specification of a node',
    'system': 'write the specification of the system that launch files start',
    'model': 'write the UPPAAL model and its queries',
    'verify': 'print the verdict table of a specification or a model',
    'explain': 'explain what a rule means and how to fix what it finds',
    'run': 'start a command with the live hook and write the specification of its nodes',
    'env': 'print the environment variables that turn the live hook on',
    'collect': 'write the specification of the nodes that `env` has recorded',
    'attach': 'write the specification of a running process',
    'why': 'explain why running nodes hang, or show that they do not',
    'confirm': 'show findings on the running node: force the order of the model',
    'explore': 'run nodes under many schedules, and repeat one that fails',
    'conform': 'check whether a recorded execution is a path of the model',
    'diff': 'compare two specifications of the same program',
    'upgrade': 'list what changes when another release of rclpy runs the nodes',
    'init': 'add the check to a ROS 2 package: test, hooks and CI jobs',
    'merge': 'merge a specification from source with one from a live run',
}
OF_RUNNING_NODES = ('run', 'env', 'collect', 'attach', 'why', 'confirm', 'explore')
WRITES_DATA = ('spec', 'system', 'merge')
HEARS_ITSELF = ('check', 'fleet', 'run', 'attach')
"""Commands that handle requests to end: they report what is known, or pass the request on."""
LONGEST_MESSAGE = 300
OBJECTS_BEFORE_COLLECTING = 100_000
"""Python looks for unused cycles after 700 new objects: 100 times before a command begins."""


class Command(Protocol):
    """What a module in `commands/` offers."""

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the arguments; must not import anything slow."""

    def run(self, args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
        """Do the work and return the exit status."""


def main(argv: Sequence[str], stdout: TextIO, stderr: TextIO) -> int:
    """Run the tool; everything it says goes to the two streams, as text that does nothing."""
    output, complaints = Shown(stdout), Shown(stderr, by_lines=True)
    return _run(list(argv), cast(TextIO, output), cast(TextIO, complaints))


def _run(argv: list[str], stdout: TextIO, stderr: TextIO) -> int:
    try:
        status = _dispatch(argv, stdout, stderr)
        stdout.flush()
        return status
    except Ros2ccError as error:
        print(f'{PROGRAM}: error: {error}', file=stderr)
        return EXIT_ERROR
    except KeyboardInterrupt:
        print(f'{PROGRAM}: interrupted', file=stderr)
        return EXIT_INTERRUPTED
    except BrokenPipeError:
        silence(raw(stdout))
        return EXIT_CLEAN
    except OSError as error:
        print(f'{PROGRAM}: error: {_refusal(error)}', file=stderr)
        return EXIT_ERROR
    except MemoryError:
        print(f'{PROGRAM}: error: not enough memory', file=stderr)
        return EXIT_ERROR
    except RecursionError:
        print(f'{PROGRAM}: error: the input is nested too deeply', file=stderr)
        return EXIT_ERROR
    except Exception as error:
        message = ' '.join(str(error).split())[:LONGEST_MESSAGE]
        print(f'{PROGRAM}: internal error: {type(error).__name__}: {message}', file=stderr)
        print('this is a bug in ros2cc-extract; ROS2CC_TRACEBACK=1 shows where', file=stderr)
        if os.environ.get('ROS2CC_TRACEBACK'):
            for line in ''.join(traceback.format_exception(error)).splitlines():
                print(line, file=stderr)
        return EXIT_ERROR


def entry_point() -> None:
    """Run as the console script."""
    gc.set_threshold(OBJECTS_BEFORE_COLLECTING)
    # The process that started us may ignore its children; we need to know how ours ended.
    if signal.getsignal(signal.SIGCHLD) is signal.SIG_IGN:
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    status = with_streams(lambda stdout, stderr: main(sys.argv[1:], stdout, stderr))
    forget_interrupt()
    sys.exit(status)


def _dispatch(argv: list[str], stdout: TextIO, stderr: TextIO) -> int:
    if not argv or argv[0] in ('-h', '--help'):
        stdout.write(_overview())
        return EXIT_CLEAN if argv else EXIT_ERROR
    if argv[0] == '--version':
        print(f'{PROGRAM} {__version__}', file=stdout)
        return EXIT_CLEAN
    name = argv.pop(0) if argv[0] in COMMANDS else DEFAULT_COMMAND
    if name == DEFAULT_COMMAND and argv:
        _ask_for_the_command(argv[0])
    module = f'live.{name}' if name in OF_RUNNING_NODES else name
    command = cast(Command, importlib.import_module(f'ros2cc_extract.cli.commands.{module}'))
    parser = argparse.ArgumentParser(
        prog=f'{PROGRAM} {name}',
        description=COMMANDS[name],
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    command.add_arguments(parser)
    try:
        args = parser.parse_args(argv)
    except SystemExit as exit_:
        return EXIT_CLEAN if not exit_.code else EXIT_ERROR
    report_missing_parts(name, args, stderr)
    if name in WRITES_DATA or getattr(args, 'output_format', 'text') != 'text':
        as_utf_8(raw(stdout))
    request = Termination()
    try:
        with termination_as_interrupt(request) if name not in HEARS_ITSELF else nullcontext():
            return command.run(args, stdout, stderr)
    except KeyboardInterrupt:
        if not request.is_asked:
            raise
        print(f'{PROGRAM}: interrupted', file=stderr)
        return request.status


def _refusal(error: OSError) -> str:
    """What the system does not let us do, unless it is reported where it happens."""
    reason = error.strerror or str(error) or type(error).__name__
    if not _has_folder():
        return 'the current folder no longer exists'
    return f'{os.fsdecode(error.filename)}: {reason}' if error.filename else reason


def _has_folder() -> bool:
    try:
        Path.cwd()
    except OSError:
        return False
    return True


def _ask_for_the_command(word: str) -> None:
    """
    Speak up where the first word is neither a path nor an option, but nearly a command.

    :raises InputError: then.
    """
    mend = did_you_mean(word, COMMANDS)
    if mend and not Path(word).exists():
        raise InputError('no such file or directory, and no command', Place(word), mend)


def _overview() -> str:
    width = max(map(len, COMMANDS))
    listing = '\n'.join(f'  {name:<{width}}  {text}' for name, text in COMMANDS.items())
    return f"""usage: {PROGRAM} PATH...            check a node file or a whole repository
       {PROGRAM} COMMAND [options]

Finds deadlocks, data races and starvation in the callbacks of ROS 2 Python nodes: extracts
callbacks, groups, executors and threads from the source, checks every interleaving with a model
checker, and reports what it finds at your own lines.

commands:
{listing}

`{PROGRAM} COMMAND --help` lists its options. Exit status: 0 clean, 1 findings, 2 usage or input
error, 3 undecided.
"""


if __name__ == '__main__':
    entry_point()
