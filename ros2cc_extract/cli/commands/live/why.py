"""``ros2cc-extract why``: why running nodes hang, or that they do not."""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Iterable
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_FINDINGS, EXIT_UNDECIDED

if TYPE_CHECKING:
    from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Explanation
    from ros2cc_extract.extract.live.why import Explained

EPILOG = """\
examples:
  ros2cc-extract why 4711
  ros2cc-extract why /navigator
  ros2cc-extract why --all --output-format mermaid

Looks twice at each process, 0.2 s apart, and leaves nothing behind. A node is searched for in all
processes of yours on this machine that run rclpy. Exit status: 0 nothing hangs; 1 a deadlock, an
executor that was never spun or is asleep, or a wait for another process; 3 undecided, or a process
that could not be looked at. Needs what `attach` needs: pip install "pyinjector>=1.3"
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = '%(prog)s [-h] [--output-format FORMAT] (PID | NODE | --all)'
    parser.epilog = EPILOG
    parser.add_argument(
        'process',
        nargs='?',
        metavar='PID | NODE',
        help='process id, or name of a node, as in /arm/planner or planner',
    )
    parser.add_argument(
        '--all',
        action='store_true',
        help='all your processes on this machine that run rclpy, and what they wait for in others',
    )
    parser.add_argument(
        '--output-format',
        choices=('text', 'json', 'html', 'mermaid'),
        default='text',
        help='default text; html is one page, mermaid draws what waits for what',
    )


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.extract.live.rclpy_processes import rclpy_processes
    from ros2cc_extract.extract.live.why import explain_all, explain_node, explain_process
    from ros2cc_extract.hang_proof.judge import judged

    if args.all == (args.process is not None):
        raise InputError('one process, one node or --all', None, 'as in: why 4711')
    if args.all:
        explained = explain_all(rclpy_processes())
        found = tuple(judged(each) for each in explained.found)
        explained = dataclasses.replace(explained, found=found)
        return _report_all(explained, args.output_format, stdout, stderr)
    if args.process.isdecimal():
        explanation = explain_process(int(args.process))
    else:
        explanation = explain_node(args.process, rclpy_processes())
    explanation = judged(explanation)
    _write((explanation,), args.output_format, stdout)
    return _status((explanation,))


def _report_all(explained: Explained, output_format: str, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.extract.live.hang_analysis.formats import all_as_json

    if output_format == 'json':
        stdout.write(all_as_json(explained.found, explained.failures))
    else:
        _write(explained.found, output_format, stdout)
    for reason in explained.failures.values():
        print(f'ros2cc-extract: {reason}', file=stderr)
    status = _status(explained.found)
    return status or (EXIT_UNDECIDED if explained.failures else EXIT_CLEAN)


def _write(found: tuple[Explanation, ...], output_format: str, stdout: TextIO) -> None:
    from ros2cc_extract.extract.live.hang_analysis.formats import as_json, as_mermaid, as_text
    from ros2cc_extract.extract.live.hang_analysis.page import as_html

    if output_format == 'json':
        stdout.write(as_json(found[0]))
    else:
        write = {'text': as_text, 'html': as_html, 'mermaid': as_mermaid}[output_format]
        stdout.write(write(found))


def _status(found: Iterable[Explanation]) -> int:
    """Findings count more than what is undecided."""
    from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Verdict

    verdicts = {each.verdict for each in found} - {Verdict.HEALTHY, Verdict.BUSY}
    if verdicts - {Verdict.UNDECIDED}:
        return EXIT_FINDINGS
    return EXIT_UNDECIDED if verdicts else EXIT_CLEAN
