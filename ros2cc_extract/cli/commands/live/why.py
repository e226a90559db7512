"""``ros2cc-extract why``: why a running node hangs, or that it does not."""

from __future__ import annotations

import argparse
from typing import TextIO

from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_FINDINGS, EXIT_UNDECIDED


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        'Looks twice, 0.2 s apart, and leaves nothing behind. Exit status: 0 nothing stands; '
        '1 deadlock,\nnobody spins, or it waits for another process; 3 undecided. Needs what '
        '`attach` needs:\npip install "hypno>=1.1"'
    )
    parser.add_argument('pid', type=int, metavar='PID', help='process id of the node')
    parser.add_argument(
        '--output-format',
        choices=('text', 'json', 'mermaid'),
        default='text',
        help='default text; mermaid draws who waits for whom',
    )


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.extract.live.hang_analysis.formats import as_json, as_mermaid, as_text
    from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Verdict
    from ros2cc_extract.extract.live.why import explain_process

    explanation = explain_process(args.pid)
    if args.output_format == 'json':
        stdout.write(as_json(args.pid, explanation))
    elif args.output_format == 'mermaid':
        stdout.write(as_mermaid(explanation))
    else:
        stdout.write(as_text(args.pid, explanation))
    if explanation.verdict in (Verdict.HEALTHY, Verdict.BUSY):
        return EXIT_CLEAN
    return EXIT_UNDECIDED if explanation.verdict is Verdict.UNDECIDED else EXIT_FINDINGS
