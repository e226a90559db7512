"""
What ``why`` says at random moments of random programs that do not hang: never a deadlock.

``python -m tests.live.moments PYTHON COUNT`` looks at the programs of ``tests/conformance``, which
run one after the other in one process. Each first look is put to the model too, as if all that
waits for an answer or a rate did so forever. Some coroutines do; what the model proves still
stands in the second look.
"""

from __future__ import annotations

import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

from ros2cc_extract.errors import Ros2ccError
from ros2cc_extract.extract.live import why
from ros2cc_extract.extract.live.hang_analysis.formats import as_text
from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind, wait_of
from ros2cc_extract.extract.live.hang_analysis.samples import Look
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import (
    Explanation,
    Standing,
    Verdict,
    explain,
)
from ros2cc_extract.hang_proof.judge import Outcome, judge
from tests.conformance.suite import DRIVER, own_environment

MOST_APART_S = 0.3
# Others are ended by threads that the model of an executor does not know.
_JUDGED = (Kind.ANSWER, Kind.ACTION, Kind.RATE)
WRONG = 'proven, and it went on'


def main(python: str, count: int) -> int:
    said: Counter[str] = Counter()
    judged: Counter[str] = Counter()
    first = random.Random(count).randrange(100_000)
    with own_environment() as environment, tempfile.TemporaryDirectory() as folder:
        programs = _Programs(python, first, count, environment, Path(folder))
        try:
            for _ in range(count):
                said[_at_this_moment(programs.running(), judged)] += 1
                time.sleep(random.uniform(0.0, MOST_APART_S))
        finally:
            programs.end()
    print(f'{count} moments, from seed {first}: {dict(said)}; by the model: {dict(judged)}')
    return min(said[Verdict.DEADLOCK.value] + judged[WRONG], 1)


class _Programs:
    """Runs programs one after the other; one that ends the process is left out."""

    def __init__(
        self, python: str, first: int, count: int, environment: Mapping[str, str], folder: Path
    ) -> None:
        self._command = [python, str(DRIVER)]
        self._first, self._count = first, count
        self._environment = environment
        self._folder = folder
        self._process = self._started()

    def running(self) -> int:
        """Give the number of the process that runs them now."""
        if self._process.poll() is not None:
            ran = self._record.read_text(encoding='utf-8') if self._record.exists() else ''
            self._first += ran.count('\n') + 1
            self._process = self._started()
        return self._process.pid

    def end(self) -> None:
        self._process.kill()
        self._process.wait()

    @property
    def _record(self) -> Path:
        return self._folder / f'{self._first}.jsonl'

    def _started(self) -> subprocess.Popen[bytes]:
        seeds = map(str, range(self._first, self._first + 100 * self._count))
        process = subprocess.Popen(
            [*self._command, str(self._record), *seeds], env=self._environment
        )
        while not self._record.exists() and process.poll() is None:
            time.sleep(0.1)
        return process


def _at_this_moment(pid: int, judgements: Counter[str]) -> str:
    looks = why._look_at([pid])[pid]
    if isinstance(looks, Ros2ccError):
        return str(looks).replace(str(pid), 'PID')
    judgements[_judged(pid, *looks)] += 1
    explanation = explain(pid, looks)
    if explanation.verdict is Verdict.DEADLOCK:
        print(as_text((explanation,)))
    return explanation.verdict.value


def _judged(pid: int, before: Look, after: Look) -> str:
    """Say what the model proves of the first look, and whether the second one contradicts."""
    waits = [(each, wait_of(each, before)) for each in before.activities if each.entities]
    waiting = [
        Standing(each, wait, moved=False, can_end=False)
        for each, wait in waits
        if wait.kind in _JUDGED and not wait.timed and not each.is_awaited_done
    ]
    told = Counter[str]()
    for each in waiting:
        outcome, reason = judge(Explanation(pid, Verdict.DEADLOCK, (each,), before))
        told[reason or outcome.value] += 1
        # Of a program that is over the entities are gone.
        is_there = set(each.activity.entities) <= set(after.entities)
        stands = any(other.stands_as(each.activity) for other in after.activities)
        if outcome is Outcome.PROVEN and is_there and not stands:
            print(f'{each.activity.place} went on')
            return WRONG
    return ', '.join(sorted(told)) or 'nothing waits'


if __name__ == '__main__':
    sys.exit(main(sys.argv[1], int(sys.argv[2])))
