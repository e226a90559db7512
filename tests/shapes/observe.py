"""
Run the nodes of the table on real rclpy and compare what they do with the table.

``python -m tests.shapes.observe --python .venv-jazzy/bin/python --as jazzy [SHAPE…]``. A node that
works prints ``goes on`` again and again; ``watched.py`` reports what stands at a line.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import asdict, dataclass
from itertools import pairwise
from pathlib import Path

from tests.shapes.rows import DISTRIBUTIONS, OTHERWISE, WAITS, Node, marked_lines, nodes
from tests.support.domains import free_domain

WATCHED = Path(__file__).with_name('watched.py')
PATIENCE_S = 9.0
# A start on a busy machine, and one who cannot even be watched.
SLACK_S = 15.0
STILL_S = 3.0
# What works does so every second.
LATE_S = 2.5
WORD = 'goes on'
# What no wheel carries.
NOT_RUN = 'not run'


@dataclass(frozen=True)
class Seen:
    """What a run did, in the word of the table, and what the word rests on."""

    what: str
    standing: tuple[int, ...]
    raised: tuple[str, ...]
    times: int
    output: str


def observe(node: Node, python: str, domain: int, patience_s: float = PATIENCE_S) -> Seen:
    """Run a node until it ends or the time is up."""
    with tempfile.TemporaryDirectory() as folder:
        record = Path(folder) / 'record.json'
        command = [python, '-u', str(WATCHED), str(node.path), str(record), str(patience_s)]
        process = subprocess.Popen(
            command,
            env={**os.environ, **_surroundings(domain)},
            cwd=folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            text=True,
        )
        lines: list[tuple[float, str]] = []
        reader = threading.Thread(target=_read, args=(process, lines), daemon=True)
        reader.start()
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(patience_s + SLACK_S)
        over = time.monotonic()
        status = process.poll()
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        reader.join(SLACK_S)
        told = json.loads(record.read_text(encoding='utf-8')) if record.exists() else None
    return _judge(node, told, status, lines, over)


def _surroundings(domain: int) -> dict[str, str]:
    return {
        'ROS_DOMAIN_ID': str(domain),
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        'PYTHONUNBUFFERED': '1',
    }


def _read(process: subprocess.Popen[str], lines: list[tuple[float, str]]) -> None:
    assert process.stdout is not None
    for line in process.stdout:
        lines.append((time.monotonic(), line.rstrip('\n')))


def _judge(
    node: Node,
    told: dict[str, list[int]] | None,
    status: int | None,
    lines: list[tuple[float, str]],
    over: float,
) -> Seen:
    words = [at for at, line in lines if line == WORD]
    output = '\n'.join(line for _, line in lines if line != WORD)
    standing = tuple(told['standing']) if told else ()
    raised = tuple(map(str, told['raised'])) if told else ()
    marked = {line for lines_of in marked_lines(node.path, WAITS) for line in lines_of}
    if told is None:
        what = 'cannot be watched' if status is None else f'ends with status {status}'
    elif marked & set(standing) and not told['ended']:
        what = 'hangs'
    elif raised and raised != ('SystemExit',):
        what = f'ends with {raised[0]}'
    elif told['ended']:
        what = 'ends'
    elif words and over - words[-1] < STILL_S:
        is_late = any(then - at > LATE_S for at, then in pairwise(words))
        what = f'{WORD} late' if is_late else WORD
    else:
        what = 'falls silent' if words else 'never goes on'
    return Seen(what, standing, raised, len(words), output[-2000:])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('shapes', nargs='*', help='names of nodes or beginnings of them')
    parser.add_argument('--python', type=Path, required=True, help='with rclpy')
    parser.add_argument('--as', dest='distribution', choices=DISTRIBUTIONS, required=True)
    parser.add_argument('--jobs', type=int, default=3)
    parser.add_argument('--record', type=Path, help='what was seen, one JSON line a node')
    args = parser.parse_args()
    chosen = [
        node
        for node in nodes()
        if node.observed[args.distribution] != NOT_RUN
        if not args.shapes or any(node.name.startswith(name) for name in args.shapes)
    ]

    def run(node: Node) -> Seen:
        with free_domain() as domain:
            return observe(node, str(args.python.absolute()), domain)

    wrong = 0
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for node, seen in zip(chosen, pool.map(run, chosen), strict=True):
            expected = node.observed[args.distribution]
            is_right = seen.what in expected.split(OTHERWISE)
            wrong += not is_right
            said = '' if is_right else f'   but the table says {expected!r}'
            print(f'{node.name:55} {seen.what}{said}', flush=True)
            if args.record:
                with args.record.open('a', encoding='utf-8') as record:
                    row = {'node': node.name, 'on': args.distribution, **asdict(seen)}
                    record.write(json.dumps(row) + '\n')
    print(f'{len(chosen)} nodes observed on {args.distribution}, {wrong} not as in the table')
    sys.exit(wrong > 0)


if __name__ == '__main__':
    main()
