"""
Random programs that wait: who hangs on real rclpy must not be *satisfied* in the model.

``python -m tests.random_waits.suite --python PYTHON --programs 1000`` draws, runs and judges
programs, and counts who hung, and of these who is found, undecided, or missed.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ros2cc_extract.checker.api import Limits
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.generator.build import Family, Profile
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.unit import Options, Verdict, verify_unit
from tests.conformance.suite import own_environment
from tests.random_waits.programs import program

WATCH = Path(__file__).with_name('watch.py')
CHUNK = 50
OPTIONS = Options(profile=Profile.RCLPY, structural=False, limits=Limits(seconds=20.0))
ENDS, FOUND, UNDECIDED = 'always ends', 'found', 'undecided'
_OF_VERDICT = {
    Verdict.SATISFIED: ENDS,
    Verdict.NOT_SATISFIED: FOUND,
    Verdict.UNDECIDED: UNDECIDED,
}


def judge(text: str) -> dict[str, str]:
    """For each function of a program whether the model lets it wait for ever."""
    judged: dict[str, str] = {}
    for unit in scan_text(text).units:
        names = _functions(unit)
        for result in verify_unit(close(unit), OPTIONS).results:
            if result.family == Family.PROGRESS.value:
                function = names.get(result.callbacks[0], result.callbacks[0])
                judged[function] = _worse(judged.get(function), _OF_VERDICT[result.verdict])
    return judged


def _functions(unit: Spec) -> dict[str, str]:
    everybody = (*unit.callbacks, *unit.activities)
    return {one.name: one.function.rpartition('.')[2] for one in everybody if one.function}


def _worse(one: str | None, other: str) -> str:
    return max(one or ENDS, other, key=(ENDS, UNDECIDED, FOUND).index)


@dataclass
class Tally:
    """What came of many programs."""

    programs: int = 0
    hung: int = 0
    judged: Counter[str] = field(default_factory=Counter)
    stuck: Counter[str] = field(default_factory=Counter)
    missed: list[tuple[int, str]] = field(default_factory=list)
    unconfirmed: list[int] = field(default_factory=list)

    def add(self, seed: int, stuck: Sequence[str], judged: Mapping[str, str]) -> None:
        """Count one program."""
        self.programs += 1
        verdicts = set(judged.values())
        of_program = max(verdicts, key=(ENDS, UNDECIDED, FOUND).index, default=ENDS)
        self.judged[of_program] += 1
        self.hung += bool(stuck)
        for function in stuck:
            verdict = judged.get(function, ENDS)
            self.stuck[verdict] += 1
            if verdict == ENDS:
                self.missed.append((seed, function))
        if of_program == FOUND and not stuck:
            self.unconfirmed.append(seed)

    def __str__(self) -> str:
        return (
            f'{self.programs} programs, {self.hung} hung; in the model {dict(self.judged)}; '
            f'functions that hung {dict(self.stuck)}; missed {self.missed}; '
            f'{len(self.unconfirmed)} found that did not hang'
        )


def watch(python: str, seeds: Sequence[int]) -> dict[int, list[str]]:
    """Run programs, and give for each the functions that stood still."""
    stuck = stuck_in_files(python, {f'waiter_{seed}': program(seed) for seed in seeds})
    return {seed: stuck[f'waiter_{seed}'] for seed in seeds if f'waiter_{seed}' in stuck}


def stuck_in_files(python: str, texts: Mapping[str, str]) -> dict[str, list[str]]:
    """Run programs by names, and give for each the functions that stood still."""
    with tempfile.TemporaryDirectory(prefix='ros2cc-waits-') as folder, own_environment() as env:
        files = {Path(folder) / f'{name}.py': name for name in texts}
        for file, name in files.items():
            file.write_text(texts[name], encoding='utf-8')
        out = Path(folder) / 'out.jsonl'
        subprocess.run([python, str(WATCH), str(out), *map(str, files)], env=env, check=True)
        rows = [json.loads(line) for line in out.read_text(encoding='utf-8').splitlines()]
        return {files[Path(row['file'])]: row['stuck'] for row in rows}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--python', required=True, help='an interpreter with rclpy')
    parser.add_argument('--first', type=int, default=0, help='first seed')
    parser.add_argument('--programs', type=int, default=1000)
    args = parser.parse_args()
    tally = Tally()
    for start in range(args.first, args.first + args.programs, CHUNK):
        seeds = range(start, min(start + CHUNK, args.first + args.programs))
        for seed, stuck in sorted(watch(args.python, seeds).items()):
            tally.add(seed, stuck, judge(program(seed)))
        print(tally, flush=True)
    return 1 if tally.missed else 0


if __name__ == '__main__':
    sys.exit(main())
