"""
What ``why`` says at random moments of random programs that do not hang: never a deadlock.

``python -m tests.live.moments PYTHON COUNT`` looks at the programs of ``tests/conformance``, which
run one after the other in one process. The model is asked of each moment too, as if all that waits
for an answer or a rate did so for ever: it never proves that.
"""

from __future__ import annotations

import dataclasses
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from ros2cc_extract.errors import Ros2ccError
from ros2cc_extract.extract.live.hang_analysis.formats import as_text
from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Verdict
from ros2cc_extract.extract.live.why import explain_process
from ros2cc_extract.hang_proof.judge import Outcome, judge
from tests.conformance.suite import DRIVER, own_environment

MOST_APART_S = 0.3
# Others are ended by threads that the model of an executor does not know.
_JUDGED = (Kind.ANSWER, Kind.ACTION, Kind.RATE)


def main(python: str, count: int) -> int:
    said: Counter[str] = Counter()
    judged: Counter[str] = Counter()
    first = random.Random(count).randrange(100_000)
    with own_environment() as environment, tempfile.TemporaryDirectory() as folder:
        seeds = map(str, range(first, first + 100 * count))
        process = subprocess.Popen(
            [python, str(DRIVER), f'{folder}/ran.jsonl', *seeds], env=environment
        )
        try:
            while not Path(folder, 'ran.jsonl').exists():
                time.sleep(0.1)
            for _ in range(count):
                said[_at_this_moment(process.pid, judged)] += 1
                time.sleep(random.uniform(0.0, MOST_APART_S))
        finally:
            process.kill()
            process.wait()
    print(f'{count} moments, from seed {first}: {dict(said)}; by the model: {dict(judged)}')
    return min(said[Verdict.DEADLOCK.value] + judged[Outcome.PROVEN.value], 1)


def _at_this_moment(pid: int, judgements: Counter[str]) -> str:
    try:
        explanation = explain_process(pid)
    except Ros2ccError as error:
        return str(error).replace(str(pid), 'PID')
    if explanation.verdict is Verdict.DEADLOCK:
        print(as_text((explanation,)))
    waiting = tuple(
        dataclasses.replace(each, can_end=False)
        for each in explanation.standings
        if each.activity.entities and each.wait.kind in _JUDGED and not each.wait.timed
    )
    if waiting:
        as_if = dataclasses.replace(
            explanation, verdict=Verdict.DEADLOCK, standings=waiting, proof=''
        )
        outcome, reason = judge(as_if)
        judgements[reason or outcome.value] += 1
        if outcome is Outcome.PROVEN:
            print(as_text((as_if,)))
    return explanation.verdict.value


if __name__ == '__main__':
    sys.exit(main(sys.argv[1], int(sys.argv[2])))
