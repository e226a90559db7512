"""
What ``why`` says of every program of ``tests/blocking``: ``make why``.

With ``--hooked`` each runs with the hook. A program that goes on is never called a deadlock, and
one that hangs is never called healthy.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

from ros2cc_extract.errors import Ros2ccError
from ros2cc_extract.extract.live.environment import hooked_environment
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import (
    NOT_PROVEN,
    Explanation,
    Verdict,
)
from ros2cc_extract.extract.live.why import explain_process
from ros2cc_extract.hang_proof.judge import judged
from tests.support.cells import Cell, all_cells
from tests.support.domains import free_domain

LIVE = Path(__file__).parent
BLOCKING = LIVE.parent / 'blocking'
BEGINS_WITHIN_S, SETTLES_S = 60.0, 1.0


@contextmanager
def program(
    python: str, text: str, path: Path, until: str = 'asks', **variables: str
) -> Iterator[subprocess.Popen[str]]:
    """Run a program until it says ``until``, and a moment longer; it is killed in the end."""
    with programs(python, {path.name: text}, until, **variables) as (process,):
        time.sleep(SETTLES_S)
        yield process


@contextmanager
def programs(
    python: str, texts: Mapping[str, str], until: str = 'asks', **variables: str
) -> Iterator[list[subprocess.Popen[str]]]:
    """Run programs in one domain until each says ``until``."""
    with ExitStack() as stack:
        domain = stack.enter_context(free_domain())
        starts = [_started(python, name, text, domain, variables) for name, text in texts.items()]
        started = [stack.enter_context(each) for each in starts]
        for process, log in started:
            _wait_until(until, process, log)
        yield [process for process, _ in started]


@contextmanager
def cells_at_once(
    python: str, cells: Sequence[Cell], **variables: str
) -> Iterator[list[subprocess.Popen[str]]]:
    """Run programs side by side, each in a domain of its own, until all of them stand or go on."""
    with ExitStack() as stack:
        started = []
        for cell in cells:
            domain = stack.enter_context(free_domain())
            start = _started(python, cell.path.name, text_of(cell), domain, variables)
            started.append(stack.enter_context(start))
        for cell, (process, log) in zip(cells, started, strict=True):
            _wait_until(awaited(cell), process, log)
        time.sleep(SETTLES_S)
        yield [process for process, _ in started]


def _wait_until(word: str, process: subprocess.Popen[str], log: Path) -> None:
    deadline = time.monotonic() + BEGINS_WITHIN_S
    while word not in log.read_text() and time.monotonic() < deadline:
        time.sleep(0.05)
        if process.poll() is not None:
            break


@contextmanager
def _started(
    python: str, name: str, text: str, domain: int, variables: Mapping[str, str]
) -> Iterator[tuple[subprocess.Popen[str], Path]]:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / name
        file.write_text(text, encoding='utf-8')
        env = {
            **os.environ,
            'ROS_DOMAIN_ID': str(domain),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
            'PYTHONUNBUFFERED': '1',
            **variables,
            'PYTHONPATH': f'{variables.get("PYTHONPATH", "")}:{BLOCKING}:{LIVE}'.lstrip(':'),
        }
        log = Path(folder) / 'log'
        with log.open('w') as stream:
            process = subprocess.Popen(
                [python, str(file)], env=env, stdout=stream, stderr=stream, text=True
            )
        try:
            yield process, log
        finally:
            process.kill()
            process.wait()


def awaited(cell: Cell) -> str:
    """Give the line after which the program does what is asked about."""
    return 'goes on' if cell.facts[0] == 'ok' else 'asks'


def text_of(cell: Cell) -> str:
    """Give the program; one that is asleep stays so until it has been looked at."""
    return cell.text.replace('threading.Timer(0.8, self.wake)', 'threading.Timer(60.0, self.wake)')


def told(explanation: Explanation) -> tuple[str, list[tuple[str, int, str | None]]]:
    """Give the verdict, and what waits forever: function, line, code."""
    stand = [each for each in explanation.standings if not each.can_end]
    return explanation.verdict.value, sorted(
        (each.activity.place.function, each.activity.place.line, each.code) for each in stand
    )


def main(python: str, names: Sequence[str], hooked: Mapping[str, str]) -> int:
    wrong, times, proofs = 0, [], Counter[str]()
    for cell in all_cells():
        if names and not any(each in cell.name for each in names):
            continue
        with program(python, text_of(cell), cell.path, awaited(cell), **hooked) as process:
            begun = time.monotonic()
            try:
                explanation = judged(explain_process(process.pid))
            except Ros2ccError as error:
                print(f'{cell.name}: {error}')
                continue
            times.append(time.monotonic() - begun)
        verdict, stand = told(explanation)
        goes_on, hangs = cell.facts[0] == 'ok', cell.facts[0] in ('blocks', 'asleep')
        is_false = (goes_on and explanation.verdict is Verdict.DEADLOCK) or (
            hangs and explanation.verdict in (Verdict.HEALTHY, Verdict.BUSY)
        )
        wrong += is_false
        proof = f' ({explanation.proof})' if explanation.proof != NOT_PROVEN else ''
        proofs[explanation.proof] += explanation.proof != NOT_PROVEN
        mark = '  WRONG' if is_false else ''
        print(f'{cell.name}: {cell.facts[0]}: {verdict}{proof} {stand}{mark}')
    if times:
        times.sort()
        print(
            f'{len(times)} programs, {wrong} wrong; median {times[len(times) // 2]:.2f} s, '
            f'worst {times[-1]:.2f} s; deadlocks: {dict(+proofs)}'
        )
    return min(wrong, 1)


if __name__ == '__main__':
    arguments = [each for each in sys.argv[1:] if each != '--hooked']
    with tempfile.TemporaryDirectory() as recordings:
        is_hooked = '--hooked' in sys.argv
        variables = hooked_environment({}, Path(recordings)) if is_hooked else {}
        sys.exit(main(arguments[0], arguments[1:], variables))
