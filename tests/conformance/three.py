"""
Random programs against three specifications: written by hand, scanned, and recorded.

``python -m tests.conformance.three --python PYTHON --programs 150`` writes each program down, runs
it by itself, and says how many of the traces are paths of each model, and which seeds are none.
"""

from __future__ import annotations

import argparse
import io
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ros2cc_extract.conform.search import Outcome
from ros2cc_extract.conform.trace import Trace, read_traces
from ros2cc_extract.conform.unit import Comparison, compare, pair_units
from ros2cc_extract.pipeline.sources import load_units
from ros2cc_extract.spec.model import Spec
from tests.conformance.programs import EVENTS, Program, draw
from tests.conformance.sources import source_of
from tests.conformance.suite import CHUNK, own_environment
from tests.conformance.units import spec_of

KINDS = ('by hand', 'scanned', 'live')
WATCHDOG_S = 30
STATES = 20_000
Units = dict[str, tuple[Spec, ...]]


@dataclass
class Tally:
    """What came of each kind of specification."""

    outcomes: Counter[tuple[str, str]] = field(default_factory=Counter)

    def add(self, kind: str, outcome: str) -> None:
        """Count one program."""
        self.outcomes[kind, outcome] += 1

    def __str__(self) -> str:
        lines = [f'{kind}: {number} {told}' for (kind, told), number in self.outcomes.items()]
        return '\n'.join(sorted(lines))


def run_program(python: str, program: Program, folder: Path) -> tuple[Trace, Units]:
    """Write a program, run it with the hook, and give its trace and what it is said to be."""
    source, trace, live = (folder / name for name in ('robot.py', 'robot.jsonl', 'live.yaml'))
    source.write_text(source_of(program))
    command = ['run', '--trace', str(trace), '-o', str(live), '--', python, str(source)]
    with own_environment() as environment:
        subprocess.run(
            [sys.executable, '-m', 'ros2cc_extract.cli.main', *command],
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            timeout=WATCHDOG_S,
            check=True,
        )
    (recorded,) = read_traces(trace)
    messages = io.StringIO()
    return recorded, {
        'by hand': (spec_of(program),),
        'scanned': load_units(source, messages),
        'live': load_units(live, messages),
    }


def told(trace: Trace, units: Sequence[Spec]) -> tuple[str, Comparison | None]:
    """What comes of the executor of the program: an outcome, or that no unit has its nodes."""
    for of_trace, executor, spec in pair_units([trace], units):
        if 'answering' not in spec.nodes:
            comparison = compare(of_trace, executor, spec, states=STATES)
            outcome = comparison.answer.outcome
            if outcome is Outcome.DIVERGES and comparison.is_gap:
                outcome = Outcome.UNDECIDED
            return outcome.value, comparison
    return 'no unit', None


def run_all(python: str, first: int, programs: int, keep: Path | None) -> Tally:
    """Run programs one by one, compare each with three specifications, and print what fails."""
    tally = Tally()
    for seed in range(first, first + programs):
        program = draw(seed)
        if (seed - first) % CHUNK == CHUNK - 1:
            print(tally, flush=True)
        if program.executor == EVENTS:
            continue
        with tempfile.TemporaryDirectory(prefix='ros2cc-conformance-') as name:
            folder = Path(name)
            trace, units = run_program(python, program, folder)
            for kind in KINDS:
                outcome, _ = told(trace, units[kind])
                tally.add(kind, outcome)
                if outcome != Outcome.CONFORMS.value:
                    print(seed, kind, outcome, flush=True)
                if outcome != Outcome.CONFORMS.value and keep is not None:
                    shutil.copytree(folder, keep / f'{seed}', dirs_exist_ok=True)
    return tally


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[1] if __doc__ else '')
    parser.add_argument('--python', default=sys.executable, help='an interpreter with rclpy')
    parser.add_argument('--first', type=int, default=400_000, help='first seed')
    parser.add_argument('--programs', type=int, default=150)
    parser.add_argument('--keep', type=Path, help='folder for programs and traces that fail')
    args = parser.parse_args()
    tally = run_all(args.python, args.first, args.programs, args.keep)
    print(tally)
    return int(any(told == Outcome.DIVERGES.value for _, told in tally.outcomes))


if __name__ == '__main__':
    sys.exit(main())
