"""
Measures the embedded checker: one child process per row, so that memory is the row's own.

    python benchmarks/checker.py            all rows but the largest
    python benchmarks/checker.py --full     also 4 callbacks on 4 threads without reduction (1 GB)
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass

from ros2cc_extract.checker.api import CheckResult, EngineKind, Query, check, read_model
from ros2cc_extract.generator import build
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    Executor,
    GroupType,
    Spec,
)


@dataclass(frozen=True)
class Row:
    """
    One measurement.

    :param groups: ``reentrant``, ``exclusive``, or ``half`` for one group of each.
    """

    title: str
    callbacks: int
    threads: int
    groups: str
    text: str
    reduction: bool
    bar: str
    engine: str = 'auto'
    all_families: bool = True
    only_full: bool = False


ROWS = (
    Row('C1, plain, Python', 4, 1, 'exclusive', 'plain', False, '1.5 s', 'reference'),
    Row('C2, plain, Python', 4, 4, 'exclusive', 'plain', False, '8 s', 'reference'),
    Row('C2, plain, no reduction', 4, 4, 'exclusive', 'plain', False, ''),
    Row('C3, plain, no reduction, Q1', 4, 4, 'reentrant', 'plain', False, '30 s, 1 GB',
        all_families=False, only_full=True),
    Row('C3, plain, no reduction', 4, 4, 'reentrant', 'plain', False, '', only_full=True),
    Row('4 x 3 reentrant, plain, no reduction', 4, 3, 'reentrant', 'plain', False, "Spin's rate",
        all_families=False),
    Row('C3, plain', 4, 4, 'reentrant', 'plain', True, '1.5 s'),
    Row('C1, compact', 4, 1, 'exclusive', 'compact', True, '0.5 s for C1-C3'),
    Row('C2, compact', 4, 4, 'exclusive', 'compact', True, ''),
    Row('C3, compact', 4, 4, 'reentrant', 'compact', True, ''),
    Row('5 x 5 reentrant, compact', 5, 5, 'reentrant', 'compact', True, '2 s for 50 cells'),
    Row('12 x 8 half and half, compact', 12, 8, 'half', 'compact', True, '1 s'),
    Row('20 x 4 reentrant, compact', 20, 4, 'reentrant', 'compact', True, '1 s'),
    Row('20 x 4 half and half, compact', 20, 4, 'half', 'compact', True, '1 s'),
    Row('12 x 8 reentrant, compact', 12, 8, 'reentrant', 'compact', True, '10 s', only_full=True),
)  # fmt: skip


def main() -> int:
    """Print the table, or be the child that measures one row."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--full', action='store_true', help='also the rows that need minutes')
    parser.add_argument('--only', help='rows whose title contains this')
    parser.add_argument('--row', type=int, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.row is not None:
        print(json.dumps(asdict(measure(ROWS[arguments.row]))))
        return 0
    for line in table(arguments.full, arguments.only):
        print(line, flush=True)
    return 0


@dataclass(frozen=True)
class Measure:
    """What a child measured; ``cpu_s`` and ``wall_s`` of the check alone."""

    states: int
    transitions: int
    wall_s: float
    cpu_s: float
    peak_mb: float
    complete: bool
    verdicts: str


def measure(row: Row) -> Measure:
    """Check the model of a row in this process."""
    rendered = build.render(close(unit(row)), text=build.Text(row.text))
    model = read_model(rendered.xml, f'{rendered.name}.xml')
    queries = [Query(q.formula, '', None) for q in rendered.queries]
    if not row.all_families:
        queries = queries[:1]
    wall, cpu = time.perf_counter(), time.process_time()
    result = check(model, queries, engine=EngineKind(row.engine), reduction=row.reduction)
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    return Measure(
        result.states,
        result.transitions,
        wall,
        cpu,
        result.peak_mb,
        result.complete,
        pattern(result),
    )


def pattern(result: CheckResult) -> str:
    """Return one letter per verdict."""
    return ''.join(answer.verdict.value[0] for answer in result.answers)


def unit(row: Row) -> Spec:
    """Return callbacks, the first half timers, dealt out to the groups in turn."""
    kinds = {
        'reentrant': [GroupType.REENTRANT],
        'exclusive': [GroupType.EXCLUSIVE],
        'half': [GroupType.REENTRANT, GroupType.EXCLUSIVE],
    }[row.groups]
    groups = tuple(CallbackGroup(name=f'G{i}', type=kind) for i, kind in enumerate(kinds))
    timers = (row.callbacks + 1) // 2
    callbacks = tuple(
        Callback(
            name=f'CB{i}',
            type=CallbackType.TMR if i < timers else CallbackType.SUB,
            group=groups[i % len(groups)].name,
        )
        for i in range(row.callbacks)
    )
    threads = tuple(f'THR{i}' for i in range(row.threads))
    return Spec(
        name='bench',
        callbacks=callbacks,
        groups=groups,
        executor=Executor(name='EXEC', threads=threads),
    )


def table(is_full: bool, only: str | None) -> Iterator[str]:
    """Yield the lines of the table, each as soon as its row is measured."""
    yield '| work | states | transitions | wall s | CPU s | states/s | peak MB | bar |'
    yield '|---|---|---|---|---|---|---|---|'
    for number, row in enumerate(ROWS):
        if (row.only_full and not is_full) or (only and only not in row.title):
            continue
        yield line(row, measure_apart(number))


def measure_apart(number: int) -> Measure:
    """Measure a row in a child process."""
    command: Sequence[str] = [sys.executable, __file__, '--row', str(number)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return Measure(**json.loads(done.stdout))


def line(row: Row, found: Measure) -> str:
    """Return one line of the table."""
    rate = found.states / max(found.wall_s, 1e-9)
    return (
        f'| {row.title} | {found.states:,} | {found.transitions:,} | {found.wall_s:.2f} |'
        f' {found.cpu_s:.2f} | {rate / 1e6:.2f} M | {found.peak_mb:.0f} | {row.bar} |'
    )


if __name__ == '__main__':
    sys.exit(main())
