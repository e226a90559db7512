"""
Compares the verdicts of slices with those of the whole unit, on units drawn by number.

``python tests/property/compared_slices.py --units 2000 --record FILE`` compares and says how many
verdicts agree, and how many were skipped: a network of too many states decides nothing. What FILE
already holds is not done again, so that a long series may be cut at any time.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import dataclass
from pathlib import Path
from random import Random

from closed_specs import random_entity_unit
from test_slices_agree import SLICED, WHOLE, WHOLE_STATES, no_unit_is_small

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.unit import verify_unit

#: First unit of the numbers of record.
FIRST = 10_000


@dataclass(frozen=True)
class Pair:
    """What the slices and the whole say of one claim."""

    sliced: QueryResult
    whole: QueryResult

    @property
    def is_skipped(self) -> bool:
        """Whether one of them has reached a limit, so that there is nothing to compare."""
        both = (self.sliced, self.whole)
        return any(r.verdict is Verdict.UNDECIDED and not r.in_doubt for r in both)

    @property
    def differs(self) -> bool:
        """Whether they contradict each other; what is in doubt contradicts nothing."""
        both = {self.sliced.verdict, self.whole.verdict}
        return both == {Verdict.SATISFIED, Verdict.NOT_SATISFIED}

    @property
    def is_doubted_once(self) -> bool:
        """Whether one of them decides what is in doubt for the other."""
        return self.sliced.in_doubt is not self.whole.in_doubt


def compared(number: int) -> dict[str, object]:
    """Compare the verdicts of one unit; those that a limit has left open are skipped."""
    unit = random_entity_unit(Random(number), callbacks=5, groups=3, threads=3)
    with no_unit_is_small():
        sliced = verify_unit(unit, SLICED)
    whole = verify_unit(unit, WHOLE)
    pairs = [Pair(*both) for both in zip(sliced.results, whole.results, strict=True)]
    both = [pair for pair in pairs if not pair.is_skipped]
    return {
        'number': number,
        'compared': len(both),
        'skipped': len(pairs) - len(both),
        'differing': [pair.sliced.words for pair in both if pair.differs],
        'doubted': [pair.sliced.words for pair in both if pair.is_doubted_once],
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--units', type=int, default=2_000)
    parser.add_argument('--first', type=int, default=FIRST)
    parser.add_argument('--record', type=Path, required=True)
    args = parser.parse_args()
    lines = args.record.read_text('utf-8').splitlines() if args.record.exists() else []
    known = {entry['number']: entry for entry in map(json.loads, lines)}
    numbers = range(args.first, args.first + args.units)
    with args.record.open('a', encoding='utf-8') as record:
        for number in numbers:
            if number not in known:
                known[number] = compared(number)
                record.write(json.dumps(known[number]) + '\n')
                record.flush()
    done = [known[number] for number in numbers]
    differing, doubted = (
        {entry['number']: entry[key] for entry in done if entry[key]}
        for key in ('differing', 'doubted')
    )
    total, left = (sum(entry[key] for entry in done) for key in ('compared', 'skipped'))
    units = sum(entry['skipped'] > 0 for entry in done)
    print(f'{len(done)} units: {total} verdicts compared')
    print(f'{left} skipped in {units} units, at a limit of {WHOLE_STATES} states or of a slice')
    print(f'in doubt on one side: {doubted or "none"}')
    print(f'differing: {differing or "none"}')
    return 1 if differing else 0


if __name__ == '__main__':
    raise SystemExit(main())
