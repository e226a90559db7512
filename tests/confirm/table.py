"""
What ``confirm`` says of every node here with a finding, and of its good twin: ``make confirm``.

A twin is forced by the schedule of the bad node, moved to the lines that correspond; whatever
never ends anywhere in it counts as falsely confirmed. Where a module is not installed, the node
and its twin run again with stand-ins. Goes on where it was cut: the record holds a line for each
node.
"""

from __future__ import annotations

import argparse
import difflib
import io
import json
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from ros2cc_extract.cli.commands.live.confirm import job
from ros2cc_extract.confirm.confirming import confirm
from ros2cc_extract.confirm.judging import confirmed
from ros2cc_extract.confirm.observations import Observations
from ros2cc_extract.confirm.processes import release_of, started
from ros2cc_extract.confirm.schedules import (
    Lines,
    Point,
    RacePlan,
    Schedule,
    can_be_tried,
    schedule_of,
)
from ros2cc_extract.confirm.statements import lines_of, tree_of
from ros2cc_extract.pipeline.check import check_paths

ROOT = Path(__file__).parents[2]
LIMIT_S, TWIN_S = 30.0, 14.0
ALIKE = 0.6
ANYWHERE = 10**6
NEEDS_MODULE = 'needs the module'


def nodes() -> list[Path]:
    """Every program that may have a finding."""
    bugs = [p for p in (ROOT / 'tests/bugs').glob('*.py') if not p.stem.endswith('_mended')]
    blocking = (ROOT / 'tests/blocking').glob('*.py')
    examples = (ROOT / 'launch_free_examples').glob('*/node.py')
    return sorted(p for p in (*bugs, *blocking, *examples) if not p.stem.startswith('test_'))


def schedules(path: Path, release: str | None) -> list[Schedule]:
    outcome = check_paths(job(path, release, cached=False), io.StringIO())
    return [schedule_of(each, outcome.units) for each in outcome.findings if can_be_tried(each)]


def onto(schedule: Schedule, twin: Path) -> Schedule:
    """Move a schedule to the lines of the twin that are most like those of the bad node."""
    bad, file = Path(schedule.path), str(twin.resolve())
    points = []
    for point in schedule.points:
        found = _like(bad, point.first, twin)
        if Path(point.file) == bad.resolve() and found is not None:
            points.append(replace(point, file=file, first=found[0], last=found[1], column=0))
    held = tuple(replace(each, file=file if each.file else '', line=0) for each in schedule.held)
    return replace(
        schedule,
        path=str(twin),
        entry=str(twin),
        points=tuple(points),
        held=held,
        race=schedule.race and _race_onto(schedule.race, bad, twin),
        forever=False,
    )


def _race_onto(race: RacePlan, bad: Path, twin: Path) -> RacePlan | None:
    moved = [_like(bad, each.first, twin) for each in (race.own, *race.others)]
    file = str(twin.resolve())
    lines = [Lines(file=file, first=each[0], last=each[1]) for each in moved if each is not None]
    if len(lines) < len(moved):
        return None
    return replace(race, own=lines[0], others=tuple(lines[1:]))


def _like(bad: Path, line: int, twin: Path) -> tuple[int, int] | None:
    """Give the lines of the statement of the twin that reads most like a line."""
    own, other = (path.read_text().splitlines() for path in (bad, twin))
    found = difflib.get_close_matches(own[line - 1].strip(), [x.strip() for x in other], 1, ALIKE)
    if not found:
        return None
    return lines_of(tree_of(twin), [x.strip() for x in other].index(found[0]) + 1)


def is_confirmed_falsely(schedule: Schedule, python: str, *, stubs: bool = False) -> str:
    """Give what is shown of a twin, at the place of the finding or anywhere else."""
    anywhere = Point(file=str(Path(schedule.entry).resolve()), first=1, last=ANYWHERE)
    wide = replace(schedule, code='CC101', points=(anywhere,), race=None)
    seen, end = Observations(), time.monotonic() + TWIN_S
    with started(schedule, python, stubs=stubs) as node:
        while time.monotonic() < end and node.process.poll() is None:
            if seen.update(node.report):
                for each in (schedule, wide):
                    found = confirmed(each, seen) if each.points else None
                    if found is not None:
                        return f'{found.reason}\n{found.evidence}'
            time.sleep(0.1)
    return ''


def rows(
    python: str, release: str | None, known: set[str], names: list[str]
) -> Iterator[dict[str, object]]:
    for path in nodes():
        if names and not any(each in str(path) for each in names):
            continue
        if str(path) in known:
            continue
        found: list[dict[str, object]] = []
        twin = path.with_name(f'{path.stem}_mended.py')
        for schedule in schedules(path, release):
            result = confirm(schedule, python, LIMIT_S)
            stubs = NEEDS_MODULE in result.judgement.reason
            if stubs:
                result = confirm(schedule, python, LIMIT_S, stubs=True)
            row: dict[str, object] = {
                'node': str(path.relative_to(ROOT)),
                'finding': f'{schedule.code}:{schedule.line}',
                'outcome': result.judgement.outcome.value,
                'reason': result.judgement.reason,
                'seconds': round(result.seconds, 1),
                'stubs': stubs,
            }
            if twin.exists():
                row['twin'] = is_confirmed_falsely(onto(schedule, twin), python, stubs=stubs)
            found.append(row)
            shown = f'{row["node"]} {row["finding"]}: {row["outcome"]} in {row["seconds"]} s'
            shown += ' with stand-ins' if stubs else ''
            false = '  TWIN CONFIRMED FALSELY' if row.get('twin') else ''
            print(f'{shown}: {row["reason"]}{false}', flush=True)
        yield {'path': str(path), 'rows': found}


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument('--python', required=True)
    parser.add_argument('--record', type=Path, required=True)
    parser.add_argument('names', nargs='*')
    args = parser.parse_args()
    release = release_of(args.python)
    kept = args.record.read_text().splitlines() if args.record.exists() else []
    done = [json.loads(line) for line in kept]
    with args.record.open('a', encoding='utf-8') as stream:
        for row in rows(args.python, release, {each['path'] for each in done}, args.names):
            stream.write(json.dumps(row) + '\n')
            stream.flush()
            done.append(row)
    return told([row for each in done for row in each['rows']])


def told(found: list[dict[str, object]]) -> int:
    false = [row for row in found if row.get('twin')]
    for family in ('CC1', 'CC3'):
        own = [row for row in found if str(row['finding']).startswith(family)]
        counts = Counter(str(row['outcome']) for row in own)
        print(f'{family}xx: {counts["confirmed"]} of {len(own)} confirmed; {dict(counts)}')
    print(f'twins: {sum("twin" in row for row in found)} runs, {len(false)} falsely confirmed')
    return bool(false)


if __name__ == '__main__':
    sys.exit(main())
