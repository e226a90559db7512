"""The part of ``verify`` that sweeps thread counts and arrival bounds."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import TextIO

from ros2cc_extract.cli.shared.arguments import options_of, policy_of, pool_of
from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_UNDECIDED
from ros2cc_extract.errors import InputError
from ros2cc_extract.jobs.pools import Pool, Processes
from ros2cc_extract.jobs.process_pool import usable_cores
from ros2cc_extract.pipeline.progress import bar
from ros2cc_extract.pipeline.sources import load_units
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.sweep import Sweep, points, run_sweep


def run_sweeps(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    """Sweep every unit of the path and print one table each, or a JSON list of all."""
    if args.path.suffix == '.xml':
        raise InputError(
            'a sweep needs a specification or source', Place(str(args.path)), 'give one number'
        )
    pool = pool_of(args) or Processes(usable_cores())
    sweeps = [
        _sweep(unit, args, pool, stderr)
        for unit in load_units(args.path, stderr, lists_builtin=args.builtin)
    ]
    if args.output_format == 'json':
        _print_json(sweeps, stdout)
    else:
        _print_text(sweeps, stdout)
    undecided = any(v.is_undecided for sweep in sweeps for v in sweep.verifications)
    return EXIT_UNDECIDED if undecided else EXIT_CLEAN


def _sweep(unit: Spec, args: argparse.Namespace, pool: Pool, stderr: TextIO) -> Sweep:
    threads = args.threads or range(len(unit.executor.threads), len(unit.executor.threads) + 1)
    settings = points(threads, args.max_cycle)
    with bar(stderr, 'verifying') as meter:
        return run_sweep(
            unit,
            policy_of(args),
            options_of(args),
            settings,
            pool,
            lambda done: meter.step(done, len(settings)),
        )


def _print_json(sweeps: Sequence[Sweep], stdout: TextIO) -> None:
    from ros2cc_extract.report.machine.json_report import to_text, verification_data

    data = [
        {
            'threads': point.threads,
            'max_cycle': point.max_cycle,
            **verification_data(verification),
        }
        for sweep in sweeps
        for point, verification in zip(sweep.points, sweep.verifications, strict=True)
    ]
    stdout.write(to_text(data))


def _print_text(sweeps: Sequence[Sweep], stdout: TextIO) -> None:
    from ros2cc_extract.report.text.style import console_for
    from ros2cc_extract.report.text.sweep import print_sweep

    console = console_for(stdout)
    for sweep in sweeps:
        print_sweep(sweep, console)
