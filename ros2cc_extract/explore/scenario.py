"""What is explored: a command, what it is sent, and where its threads may be held; its file."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, field
from pathlib import Path
from typing import Any

from ros2cc_extract.confirm.processes import READY, REPORT, Stimulus
from ros2cc_extract.errors import InputError
from ros2cc_extract.explore.failures import Failure, Kind
from ros2cc_extract.explore.points import Point
from ros2cc_extract.files import read_regular
from ros2cc_extract.json_text import read_json
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

_VERSION = 1
_MOST_BYTES = 4_000_000
PLAIN = 'plain'
Row = Mapping[str, Any]


@dataclass(frozen=True, kw_only=True)
class Scenario:
    """
    :param command: as a user would type it.
    :param known: callbacks that may be ready soon, and are waited for.
    :param everywhere: threads switch at every point, as without the interpreter's global lock.
    :param seconds: how long a schedule lasts at most.
    """

    command: tuple[str, ...]
    stimulus: Stimulus = field(default_factory=Stimulus)
    points: tuple[Point, ...] = ()
    known: tuple[str, ...] = ()
    everywhere: bool = False
    seconds: float = 1.5


def plan_text(scenario: Scenario, schedules: Sequence[Row], watcher: int, folder: Path) -> str:
    """Give the plan of one process, as ``exploring/exploration.py`` reads it."""
    row = {
        'report': str(folder / REPORT),
        'surroundings': str(folder / READY) if scenario.stimulus.is_sent else '',
        'points': [asdict(each) for each in scenario.points],
        'known': scenario.known,
        'everywhere': scenario.everywhere,
        'limits': {'seconds': scenario.seconds},
        'schedules': list(schedules),
        'watcher': watcher,
    }
    return json.dumps(row)


@dataclass(frozen=True, kw_only=True)
class Found:
    """
    A failure, and the schedule that leads there.

    :param schedule: its policy and its seed.
    :param number: which schedule of the exploration it was, from 1 on; 0 the plain one.
    :param tail: the choices from the last moment on at which no thread was at work.
    :param choices: all of the schedule until the failure.
    :param times: in how many schedules it was seen.
    """

    failure: Failure
    schedule: Row
    number: int
    tail: tuple[tuple[str, str], ...]
    choices: tuple[tuple[str, str], ...]
    seconds: float = 0.0
    times: int = 1


def write_found(found: Found, scenario: Scenario, release: str | None) -> str:
    """Give the text of a file that ``read_found`` reads."""
    row = {
        'ros2cc_explore': _VERSION,
        'rclpy': release,
        'command': scenario.command,
        'stimulus': asdict(scenario.stimulus),
        'points': [asdict(each) for each in scenario.points],
        'everywhere': scenario.everywhere,
        'failure': {**asdict(found.failure), 'kind': found.failure.kind.value},
        'schedule': dict(found.schedule),
        'number': found.number,
        'tail': found.tail,
        'choices': found.choices,
    }
    return json.dumps(row, indent=1) + '\n'


def read_found(path: Path) -> tuple[Scenario, Found]:
    """
    Read a failure that was written.

    :raises InputError: if the file is not a scenario.
    """
    try:
        row = read_json(read_regular(path, _MOST_BYTES))
        if row['ros2cc_explore'] != _VERSION:
            raise ValueError('of another version')
        return _read(row)
    except OSError as error:
        raise InputError(f'cannot be read: {error.strerror}', Place(str(path))) from error
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        what = 'is no schedule that explore has written'
        raise InputError(what, Place(str(path)), 'explore -- CMD writes one') from error


def _read(row: Row) -> tuple[Scenario, Found]:
    command = tuple(map(str, row['command']))
    if not command or isinstance(row['command'], str):
        raise ValueError('no command')
    stimulus = Stimulus(**{**row['stimulus'], 'values': tuple(row['stimulus']['values'])})
    scenario = Scenario(
        command=command,
        stimulus=stimulus,
        points=tuple(Point(**each) for each in row['points']),
        everywhere=bool(row['everywhere']),
    )
    failure = Failure(**{**row['failure'], 'kind': Kind(row['failure']['kind'])})
    found = Found(
        failure=failure,
        schedule={**row['schedule'], 'policy': str(row['schedule']['policy'])},
        number=int(row['number']),
        tail=_choices(row['tail']),
        choices=_choices(row['choices']),
    )
    return scenario, found


def _choices(rows: Sequence[Sequence[str]]) -> tuple[tuple[str, str], ...]:
    return tuple((str(key), str(at)) for key, at in rows)
