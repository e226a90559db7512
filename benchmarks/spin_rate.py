"""
Measures Spin on the published model beside the embedded checker: same states, one query (Q1).

    python benchmarks/spin_rate.py           4 callbacks on 3 threads, one reentrant group
    python benchmarks/spin_rate.py --full    also 4 on 4 (40 million states, up to 4 GB)

Needs ``spin`` (Debian package of that name) and ``gcc``. The Promela text is made from
``spin/plain.pml.j2``. Spin 6.5.2 by its own documentation (``spin --``, ``pan --``):

* ``-a -o2`` keeps variables that are only written; without it the states are fewer than the
  model's, as no query reads which callback a thread was given.
* ``-O2 -DSAFETY`` is customary for a search for deadlocks; ``-DNOREDUCE -DNOBOUNDCHECK
  -DNOFAIR`` leave out what cannot help here. ``-w`` is the size of the hash table, ``-m`` the
  depth of the search.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import jinja2
from checker import Row, measure

TEMPLATE = Path(__file__).parent / 'spin' / 'plain.pml.j2'
PROGRAMS = ('spin', 'gcc')
GENERATE = ('spin', '-a', '-o2', 'model.pml')
COMPILE = ('gcc', '-O2', '-DSAFETY', '-DNOREDUCE', '-DNOBOUNDCHECK', '-DNOFAIR', '-DMEMLIM=8000')
DEPTH = 3_000_000
HASH_BITS = (22, 24, 26)


@dataclass(frozen=True)
class SpinRun:
    """
    What Spin found and what it cost.

    :param transitions: as Spin counts them, less the one it counts for the initial state.
    :param seconds: CPU time of the compiled search, without generating and compiling it.
    :param wall_s: time of the search on the clock.
    :param complete: false when it ran out of memory or depth.
    """

    states: int
    transitions: int
    seconds: float
    wall_s: float
    peak_mb: float
    complete: bool


def missing() -> str | None:
    """Say which program is not installed, if one is not."""
    absent = [name for name in PROGRAMS if shutil.which(name) is None]
    return f'not measured: {" and ".join(absent)} not installed' if absent else None


def promela(callbacks: int, threads: int, *, exclusive: bool) -> str:
    """Write the model; the first half of the callbacks are timers, as in ``checker.unit``."""
    environment = jinja2.Environment(
        trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined
    )
    template = environment.from_string(TEMPLATE.read_text(encoding='utf-8'))
    return template.render(
        callbacks=callbacks,
        timers=(callbacks + 1) // 2,
        threads=threads,
        exclusive=exclusive,
        max_cycle=1,
    )


def run_spin(text: str, hash_bits: int = 24) -> SpinRun:
    """Generate, compile and run the search for deadlocks, one core."""
    with tempfile.TemporaryDirectory(prefix='spin-') as folder:
        Path(folder, 'model.pml').write_text(text, encoding='utf-8')
        for command in (GENERATE, (*COMPILE, '-o', 'pan', 'pan.c')):
            subprocess.run(command, cwd=folder, check=True, capture_output=True)
        return _searched(Path(folder), hash_bits)


def _searched(folder: Path, hash_bits: int) -> SpinRun:
    command = ['./pan', f'-m{DEPTH}', f'-w{hash_bits}']
    started = time.perf_counter()
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    report = process.stdout.read()
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return SpinRun(
        states=_figure(report, 'states, stored'),
        transitions=_figure(report, 'transitions') - 1,
        seconds=used.ru_utime + used.ru_stime,
        wall_s=time.perf_counter() - started,
        peak_mb=used.ru_maxrss / 1024,
        complete='errors: 0' in report and 'Search not completed' not in report,
    )


def _figure(report: str, what: str) -> int:
    match = re.search(rf'(\d+) {what}', report)
    return int(match.group(1)) if match else 0


def fastest(callbacks: int, threads: int, *, exclusive: bool) -> SpinRun:
    """Run once for each size of the hash table and keep what suits Spin best."""
    text = promela(callbacks, threads, exclusive=exclusive)
    return min((run_spin(text, bits) for bits in HASH_BITS), key=lambda run: run.seconds)


def main() -> int:
    """Print one line per size and program."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--full', action='store_true', help='also 4 callbacks on 4 threads')
    arguments = parser.parse_args()
    if reason := missing():
        print(reason)
        return 0
    print('| case | program | states | transitions | wall s | CPU s | states/s | peak MB |')
    print('|---|---|---|---|---|---|---|---|')
    for threads in (3, 4) if arguments.full else (3,):
        print_pair(4, threads)
    return 0


def print_pair(callbacks: int, threads: int) -> None:
    row = Row('', callbacks, threads, 'reentrant', 'plain', False, '', all_families=False)
    ours = min((measure(row) for _ in HASH_BITS), key=lambda run: run.cpu_s)
    spin = fastest(callbacks, threads, exclusive=False)
    if (spin.states, spin.transitions) != (ours.states, ours.transitions):
        print(f'counts differ: {spin} {ours}', file=sys.stderr)
    for program, run, cpu_s in (('ours', ours, ours.cpu_s), ('Spin', spin, spin.seconds)):
        print(
            f'| {callbacks} x {threads} reentrant | {program} | {run.states:,} |'
            f' {run.transitions:,} | {run.wall_s:.2f} | {cpu_s:.2f} |'
            f' {run.states / cpu_s / 1e6:.2f} M | {run.peak_mb:.0f} |',
            flush=True,
        )


if __name__ == '__main__':
    sys.exit(main())
