"""
Compares the verdicts of slices with those of the whole unit, on units drawn by number.

``python tests/property/compared_slices.py --units 2000 --record FILE`` compares and says how many
verdicts agree. What FILE already holds is not done again, so that a long series may be cut at any
time.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import replace
from pathlib import Path
from random import Random

from closed_specs import random_entity_unit
from test_slices_agree import SLICED, WHOLE, no_unit_is_small

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.verify.unit import verify_unit

#: First unit of the numbers of record.
FIRST = 10_000


def compared(number: int) -> dict[str, object]:
    """Verdicts of one unit: how many were compared, how many were open on a side, what differs."""
    unit = random_entity_unit(Random(number), callbacks=5, groups=3, threads=3)
    with no_unit_is_small():
        sliced = verify_unit(unit, replace(SLICED, structural=False))
    whole = verify_unit(unit, replace(WHOLE, structural=False))
    pairs = list(zip(sliced.results, whole.results, strict=True))
    both = [pair for pair in pairs if Verdict.UNDECIDED not in (r.verdict for r in pair)]
    return {
        'number': number,
        'compared': len(both),
        'open': len(pairs) - len(both),
        'differing': [one.words for one, other in both if one.verdict is not other.verdict],
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
    differing = {entry['number']: entry['differing'] for entry in done if entry['differing']}
    total, left = (sum(entry[key] for entry in done) for key in ('compared', 'open'))
    print(f'{len(done)} units: {total} verdicts compared, {left} open on one side')
    print(f'differing: {differing or "none"}')
    return 1 if differing else 0


if __name__ == '__main__':
    raise SystemExit(main())
