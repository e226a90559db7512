"""
Measures the embedded checker: one child process per row, so that time and memory are its own.

    python benchmarks/checker.py            all rows but the largest
    python benchmarks/checker.py --full     also 4 callbacks on 4 threads without reduction (1 GB)

``wall`` and ``CPU`` are of the check alone, or of all checks of the row; ``process`` is the CPU
time of the whole child, with the start of Python, generation of the models and their parsing.
On a machine that does other things, only CPU time means anything.
"""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass

from ros2cc_extract.checker.api import (
    CheckResult,
    EngineKind,
    Query,
    Reductions,
    check,
    read_model,
)
from ros2cc_extract.checker.engines.search import Symmetry
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
    One check.

    :param groups: ``reentrant``, ``exclusive``, or ``half`` for one group of each.
    """

    title: str
    callbacks: int
    threads: int
    groups: str
    text: str
    reduction: bool | Reductions
    bar: str
    engine: str = 'auto'
    all_families: bool = True
    only_full: bool = False


def plain(title: str, callbacks: int, threads: int, groups: str, bar: str, **more: bool) -> Row:
    """Return a check of the plain text without reductions."""
    return Row(title, callbacks, threads, groups, 'plain', False, bar, **more)  # type: ignore[arg-type]


def compact(callbacks: int, threads: int, groups: str, bar: str) -> Row:
    """Return a check of the compact text, which ``verify`` does without reductions."""
    title = f'{callbacks} x {threads} {groups}, compact'
    return Row(title, callbacks, threads, groups, 'compact', False, bar)


CHAINS = Reductions(dead=False, symmetry=Symmetry.NEVER)


def chains(title: str, callbacks: int, threads: int, *, only_full: bool = False) -> Row:
    """Return a check of the plain text that runs through chains, and is otherwise complete."""
    return Row(title, callbacks, threads, 'reentrant', 'plain', CHAINS, '',
               all_families=False, only_full=only_full)  # fmt: skip


ROWS = (
    Row('C1, plain, Python', 4, 1, 'exclusive', 'plain', False, '1.5 s', 'reference'),
    Row('C2, plain, Python', 4, 4, 'exclusive', 'plain', False, '8 s', 'reference'),
    plain('C2, plain, no reduction', 4, 4, 'exclusive', ''),
    plain('C3, plain, no reduction, Q1', 4, 4, 'reentrant', '39,533,348 / 85,668,514, 30 s, 1 GB',
          all_families=False, only_full=True),
    chains('C3, plain, chains run through, Q1', 4, 4, only_full=True),
    plain('C3, plain, no reduction', 4, 4, 'reentrant', '', only_full=True),
    plain('4 x 3 reentrant, plain, no reduction, Q1', 4, 3, 'reentrant', "Spin's rate",
          all_families=False),
    chains('4 x 3 reentrant, plain, chains run through, Q1', 4, 3),
    Row('C3, plain', 4, 4, 'reentrant', 'plain', True, '1.5 s'),
    compact(12, 8, 'reentrant', '10 s'),
    compact(12, 8, 'half', '1 s'),
    compact(20, 4, 'reentrant', '1 s'),
    compact(20, 4, 'exclusive', '1 s'),
    compact(20, 4, 'half', '1 s'),
    compact(20, 8, 'reentrant', '1 s'),
    compact(40, 16, 'reentrant', '15 s'),
)  # fmt: skip

CASES = tuple(
    compact(4, t, g, '') for t, g in ((1, 'exclusive'), (4, 'exclusive'), (4, 'reentrant'))
)
CELLS = tuple(
    compact(callbacks, threads, groups, '')
    for groups in ('exclusive', 'reentrant')
    for threads in range(1, 6)
    for callbacks in range(1, 6)
)
#: Title, checks, and bar of what is measured in one process.
BATCHES = (
    *((row.title, (row,), row.bar) for row in ROWS),
    ('C1, C2 and C3 (87 verdicts as published), compact', CASES, '0.5 s process'),
    ('50 cells of the cost table, all families, compact', CELLS, '2 s'),
)


def main() -> int:
    """Print the table, or be the child that measures one line of it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--full', action='store_true', help='also the rows that need minutes')
    parser.add_argument('--only', help='rows whose title contains this')
    parser.add_argument('--batch', type=int, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.batch is not None:
        print(json.dumps(asdict(total([measure(row) for row in BATCHES[arguments.batch][1]]))))
        return 0
    for line in table(arguments.full, arguments.only):
        print(line, flush=True)
    return 0


@dataclass(frozen=True)
class Measure:
    """What a child measured; ``cpu_s`` and ``wall_s`` of the checks alone."""

    states: int
    transitions: int
    wall_s: float
    cpu_s: float
    peak_mb: float
    complete: bool
    verdicts: str


def total(found: Sequence[Measure]) -> Measure:
    """Return several measures of one process as one."""
    return Measure(
        sum(one.states for one in found),
        sum(one.transitions for one in found),
        sum(one.wall_s for one in found),
        sum(one.cpu_s for one in found),
        max(one.peak_mb for one in found),
        all(one.complete for one in found),
        ' '.join(one.verdicts for one in found),
    )


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
    heads = (
        'work',
        'states',
        'transitions',
        'wall s',
        'CPU s',
        'process s',
        'states/s',
        'MB',
        'bar',
    )
    yield f'| {" | ".join(heads)} |'
    yield '|' + '---|' * len(heads)
    for number, (title, rows, bar) in enumerate(BATCHES):
        is_left_out = not is_full and any(row.only_full for row in rows)
        if not is_left_out and (only or '') in title:
            yield line(title, bar, *measure_apart(number))


def measure_apart(number: int) -> tuple[Measure, float]:
    """Measure a batch in a child process; return also the CPU time of all of the child."""
    command: Sequence[str] = [sys.executable, __file__, '--batch', str(number)]
    before = cpu_of_children()
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return Measure(**json.loads(done.stdout)), cpu_of_children() - before


def cpu_of_children() -> float:
    """Return the CPU time of all children so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def line(title: str, bar: str, found: Measure, process_s: float) -> str:
    """Return one line of the table."""
    rate = found.states / max(found.cpu_s, 1e-9)
    return (
        f'| {title} | {found.states:,} | {found.transitions:,} | {found.wall_s:.2f} |'
        f' {found.cpu_s:.2f} | {process_s:.2f} | {rate / 1e6:.2f} M | {found.peak_mb:.0f} |'
        f' {bar} |'
    )


if __name__ == '__main__':
    sys.exit(main())
