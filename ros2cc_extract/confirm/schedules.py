"""
From a finding and its run to a schedule: what must have begun before what may end it.

The order is that of the model's counterexample: every wait of the run is reached, and only then
may a callback begin that would end one. Nothing else of the run is forced, as nothing else of it
decides whether the waits end.
"""

from __future__ import annotations

import ast
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, field, replace
from pathlib import Path
from typing import Any

from ros2cc_extract.confirm.statements import lines_of, tree_of, values_compared
from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.errors import InputError
from ros2cc_extract.files import read_regular
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.json_text import read_json
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Callback, EntityKind, Spec

_VERSION = 1
_MOST_BYTES = 1_000_000
_LOCKS = 'CC111'
_LOCK_OVER_WAIT = 'CC115'
_SPUN_TWICE = 'CC107'
_PAUSE_S = 1.0
CONFIRMABLE = frozenset(
    {
        *(f'CC{number}' for number in range(101, 120)),
    }
)
"""Rules whose findings can be shown on a running node."""
CLEARED = 'CC305'
RACES = frozenset({'CC301', 'CC302', 'CC303', 'CC304', CLEARED})
# What the code that destroys something waits for, see ``steering/destroys.py``.
_DESTROYS = {'CC116': 'call', 'CC117': 'spin'}
_LAST_LINE = 10**6
_TOGETHER = 3
_KINDS = {EntityKind.CLIENT: 'client', EntityKind.SERVICE: 'service'}


@dataclass(frozen=True, kw_only=True)
class Point:
    """A statement that is to be reached; fields as in ``steering/plan.py``."""

    file: str
    first: int
    last: int
    column: int = 0
    count: int = 1
    holds: bool = False
    pause_s: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Lines:
    """Lines of a statement."""

    file: str
    first: int
    last: int


@dataclass(frozen=True, kw_only=True)
class Held:
    """A callback that is held back; fields as in ``steering/plan.py``."""

    kind: str = ''
    function: str = ''
    file: str = ''
    line: int = 0
    key: str = ''
    soft: bool = False


@dataclass(frozen=True, kw_only=True)
class RacePlan:
    """Accesses to one attribute that are to meet; fields as in ``steering/races.py``."""

    attribute: str
    own: Lines
    others: tuple[Lines, ...]
    is_use: bool = False


@dataclass(frozen=True, kw_only=True)
class Schedule:
    """
    How a finding is to be shown.

    :param code, path, line: of the finding.
    :param entry: the file to start, and the function that its console script calls.
    :param points: the first is the place of the finding.
    :param values: what messages are filled with, after their defaults.
    :param forever: the finding says that the wait never ends.
    :param leaves: the finding says that its node leaves the executor for good.
    :param race: the finding is about an attribute that two threads write.
    :param runs_inside: the finding says that other callbacks run inside its own.
    :param defaults: every other message holds its defaults.
    :param filled: the others hold values; if not, all hold their defaults.
    :param at_once: how many requests of one service are on their way at a time.
    :param destroys: what the destroyer of an entity at the first point waits for.
    :param times_out_s: the finding says that the wait always takes so long, in vain.
    """

    code: str
    path: str
    line: int
    message: str
    entry: str
    function: str
    points: tuple[Point, ...]
    held: tuple[Held, ...] = ()
    values: tuple[str | int | float, ...] = field(default=())
    forever: bool = False
    leaves: bool = False
    race: RacePlan | None = None
    runs_inside: bool = False
    at_once: int = 1
    defaults: bool = True
    filled: bool = True
    destroys: str = ''
    times_out_s: float | None = None


def can_be_tried(finding: Finding) -> bool:
    """Whether there is a way to show it; a note claims nothing that could be shown."""
    return finding.code in CONFIRMABLE | RACES and finding.severity is not Severity.NOTE


def schedule_of(finding: Finding, units: Sequence[Spec]) -> Schedule:
    """Make the schedule of one finding; ``units`` are all of the scan."""
    within = [each for each in units if finding.place.file in each.sources]
    unit = next((each for each in units if each.name == finding.unit), (*within, None)[0])
    entry, function = _entry(finding, [unit, *within])
    tree = tree_of(Path(finding.place.file))
    points = tuple(_points(finding))
    return Schedule(
        code=finding.code,
        path=finding.place.file,
        line=finding.place.line,
        message=finding.message,
        entry=entry,
        function=function,
        points=points,
        held=tuple(_held(finding, unit)) if unit is not None else (),
        values=tuple(values_compared(tree)),
        forever='forever' in finding.message and 'unless' not in finding.message,
        race=_race(finding),
        at_once=_TOGETHER if finding.code in RACES else 1,
        runs_inside='run inside this one' in finding.message,
        leaves='the node leaves its' in finding.message,
        destroys=_DESTROYS.get(finding.code, ''),
        times_out_s=_time_out(finding, unit),
    )


def _entry(finding: Finding, units: Sequence[Spec | None]) -> tuple[str, str]:
    """The program that has the finding: that of its unit, else one that reads its file."""
    for each in units:
        if each is not None and each.entry:
            file, colon, function = each.entry.rpartition(':')
            if colon and file.endswith('.py'):
                return file, function
            if each.entry.endswith('.py'):
                return each.entry, ''
    return finding.place.file, ''


def _race(finding: Finding) -> RacePlan | None:
    """What is written in several places; of one that overlaps itself, twice in the same place."""
    attribute = next((each for each in finding.subjects if '.' in each), '')
    if finding.code not in RACES or not attribute:
        return None
    own, is_use = _lines(finding.place), finding.code == CLEARED
    others = [r.place for r in finding.related if ' writes ' in r.text or ' changes ' in r.text]
    # It counts only where it sets to None, wherever in the file that is.
    itself = replace(own, first=1, last=_LAST_LINE) if is_use else own
    return RacePlan(
        attribute=attribute.rpartition('.')[2],
        own=own,
        others=tuple(map(_lines, others)) or (itself,),
        is_use=is_use,
    )


def _lines(place: Place) -> Lines:
    path = Path(place.file)
    first, last = lines_of(tree_of(path), place.line)
    return Lines(file=str(path.resolve()), first=first, last=last)


def _time_out(finding: Finding, unit: Spec | None) -> float | None:
    # Of several callbacks: they always time out.
    if unit is None or ' always time' not in finding.message:
        return None
    blocks = (block for each in unit.callbacks for block in each.blocking)
    found = (each.seconds for each in blocks if each.source == finding.place)
    return next((float(each) for each in found if isinstance(each, (int, float))), None)


def _points(finding: Finding) -> Iterator[Point]:
    meets = finding.code == _LOCKS and len(set(finding.subjects[:2])) == 2
    meets = meets and len(finding.subjects) == 4
    first = _point(finding.place, holds=meets)
    # Two threads that both make the global executor would spin two.
    yield replace(first, pause_s=_PAUSE_S) if finding.code == _SPUN_TWICE else first
    for remark in finding.related:
        if 'waits here' in remark.text or (meets and ' takes ' in remark.text):
            yield _point(remark.place, holds=meets)
        elif finding.code == _LOCK_OVER_WAIT and remark.text.endswith('is taken here'):
            yield _point(remark.place)


def _point(place: Place, *, holds: bool = False) -> Point:
    path = Path(place.file)
    first, last = lines_of(tree_of(path), place.line)
    return Point(
        file=str(path.resolve()),
        first=first,
        last=last,
        column=place.column if holds else 0,
        holds=holds,
    )


def _held(finding: Finding, unit: Spec) -> Iterator[Held]:
    """What ends the waits of the run, and softly all else that has no part in it."""
    known = {each.name: each for each in unit.callbacks}
    events = [e for m in (finding.run.moments if finding.run else ()) for e in m.events]
    starts = {e.who for e in events if e.kind == 'start'} or set(finding.subjects)
    if finding.code in RACES:
        starts = {each for each in finding.subjects if '.' not in each and each in known}
        starts &= set(finding.subjects[:2])
    starts |= {each.name for each in unit.callbacks if _is_inside(finding.place, each)}
    waiters = starts | set(finding.subjects[: 2 if finding.code == _LOCKS else 1])
    # A nested spin may take the node away while something of it is held.
    waits = [e for e in events if e.is_wait and not e.is_for_lock and e.form != 'taken']
    enders = {name for e in waits for name in e.enders} | set(finding.subjects[1:])
    for name, callback in known.items():
        if name not in waiters:
            held = _of_callback(callback)
            if held is not None and (name in enders or not callback.builtin):
                is_soft = name not in enders or finding.code in RACES
                yield replace(held, soft=is_soft)


def _is_inside(place: Place, callback: Callback) -> bool:
    """Whether the place is in the function of the callback itself."""
    defined = callback.defined
    if defined is None or defined.file != place.file:
        return False
    functions = [
        node
        for node in ast.walk(tree_of(Path(place.file)))
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))
        and node.lineno <= place.line <= (node.end_lineno or 0)
    ]
    return any(node.lineno == defined.line for node in functions)


def _of_callback(callback: Callback) -> Held | None:
    if callback.entity is EntityKind.ACTION_SERVER and isinstance(callback.key, str):
        return Held(kind='actionserver', key=callback.key)
    defined = callback.defined
    if defined is not None and callback.function_name and callback.entity is not EntityKind.CLIENT:
        file = str(Path(defined.file).resolve())
        return Held(function=callback.function_name, file=file, line=defined.line)
    if callback.entity in _KINDS and isinstance(callback.key, str):
        return Held(kind=_KINDS[callback.entity], key=callback.key)
    return None


def write_schedule(schedule: Schedule) -> str:
    """Give the text of a file that ``read_schedule`` reads."""
    return json.dumps({'ros2cc_confirm': _VERSION, **asdict(schedule)}, indent=2) + '\n'


def read_schedule(path: Path) -> Schedule:
    """
    Read a schedule that was kept.

    :raises InputError: if the file is not a schedule.
    """
    try:
        row = read_json(read_regular(path, _MOST_BYTES))
        if row.pop('ros2cc_confirm') != _VERSION:
            raise ValueError('of another version')
        return _schedule(row)
    except OSError as error:
        raise InputError(f'cannot be read: {error.strerror}', Place(str(path))) from error
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        what = 'is no schedule that confirm has written'
        raise InputError(what, Place(str(path)), 'write one with confirm --keep') from error


def _race_of(row: Mapping[str, Any]) -> RacePlan:
    return RacePlan(
        attribute=row['attribute'],
        own=Lines(**row['own']),
        others=tuple(Lines(**each) for each in row['others']),
        is_use=bool(row['is_use']),
    )


def _schedule(row: Mapping[str, Any]) -> Schedule:
    race = row['race']
    lists: dict[str, Any] = {
        'points': tuple(Point(**each) for each in row['points']),
        'held': tuple(Held(**each) for each in row['held']),
        'values': tuple(row['values']),
        'race': race and _race_of(race),
    }
    return Schedule(**{**row, **lists})
