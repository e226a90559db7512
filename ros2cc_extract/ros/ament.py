"""
``ament_ros2cc``: the check as an ament linter, for ``colcon test`` and pre-commit.

Errors and warnings fail it; notes are printed. A verdict that stayed undecided does not, since no
change of the code under test need be the reason.
Source of the interface: ament_lint 0.17, ``ament_flake8/main.py``.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_ERROR, EXIT_FINDINGS
from ros2cc_extract.cli.shared.output import write_atomically
from ros2cc_extract.cli.shared.streams import with_streams
from ros2cc_extract.diagnostics import Diagnostic, Severity, unreadable_folder
from ros2cc_extract.errors import Ros2ccError
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.packages.manifest import package_name, python_files
from ros2cc_extract.pipeline.check import Outcome, check_paths
from ros2cc_extract.pipeline.config import load_config, read_config
from ros2cc_extract.report.machine.junit import junit
from ros2cc_extract.report.shared.last_line import last_line
from ros2cc_extract.report.text.findings import print_findings
from ros2cc_extract.report.text.paths import Paths
from ros2cc_extract.report.text.style import console_for
from ros2cc_extract.ros.standard import standard_job


def main(argv: Sequence[str] | None = None) -> int:
    """Check, print what is found, and give 0 when nothing fails."""
    return main_with_errors(argv)[0]


def entry_point() -> int:
    """Run as the console script."""
    return with_streams(lambda stdout, stderr: main())


def main_with_errors(argv: Sequence[str] | None = None) -> tuple[int, list[str]]:
    """Check as ``main`` does, and give each failure as one line too."""
    args = _parser().parse_args(sys.argv[1:] if argv is None else list(argv))
    try:
        return _check(args)
    except Ros2ccError as error:
        print(f'ament_ros2cc: error: {error}', file=sys.stderr)
        return EXIT_ERROR, [str(error)]


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='ament_ros2cc',
        description='Check what the callbacks of ROS 2 Python nodes can do to each other.',
    )
    parser.add_argument(
        'paths',
        nargs='*',
        type=Path,
        default=[Path()],
        help="files or directories; of directories files ending in '.py', all as one program",
    )
    parser.add_argument(
        '--config', type=Path, metavar='PATH', help='a TOML file with a table [tool.ros2cc]'
    )
    parser.add_argument(
        '--exclude', nargs='*', default=[], metavar='FILENAME', help='file names to leave out'
    )
    parser.add_argument('--xunit-file', type=Path, metavar='PATH', help='write a JUnit XML file')
    return parser


def _check(args: argparse.Namespace) -> tuple[int, list[str]]:
    config = load_config(args.paths[0]) if args.config is None else read_config(args.config)
    barred: list[Diagnostic] = []
    files = python_files(
        args.paths, args.exclude, on_error=lambda error: barred.append(unreadable_folder(error))
    )
    outcome = check_paths(standard_job(files, config, barred), sys.stderr)
    failures = [f for f in outcome.findings if f.severity is not Severity.NOTE]
    _report(outcome, len(failures))
    if args.xunit_file is not None:
        seen = outcome.extraction.files_seen
        line = last_line(outcome.summary)
        text = junit(outcome.findings, seen, package_name(args.paths[0]), line=line)
        write_atomically(args.xunit_file, text)
    return EXIT_FINDINGS if failures else EXIT_CLEAN, [_line(f) for f in failures]


def _report(outcome: Outcome, failures: int) -> None:
    print_findings(outcome.findings, Paths(Path.cwd()), console_for(sys.stdout))
    undecided = outcome.summary['undecided']
    if undecided:
        print(f'{undecided} verdicts undecided: run ros2cc-extract for details')
    print(f'{len(outcome.extraction.files_seen)} files checked')
    print(f'{failures} errors' if failures else 'No problems found')


def _line(finding: Finding) -> str:
    return f'{finding.place}: {finding.code} {finding.message}'


if __name__ == '__main__':
    sys.exit(entry_point())
