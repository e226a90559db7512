"""
Hostile files of what runs code once somebody has said so: schedules, and records of a flight.

Without ``--yes`` nothing of them may start, as nobody is there to ask; with it, what is started is
a program of ours that ends at once, whatever else the file says.
"""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from ros2cc_extract.confirm.schedules import Held, Lines, Point, RacePlan, Schedule, write_schedule
from ros2cc_extract.explore.scenario import write_found
from ros2cc_extract.extract.live.hook.flight import COPY, TURNS
from ros2cc_extract.extract.live.recorder.events import RAW_SUFFIX
from tests.attack.arena import Attempt
from tests.attack.mutations import as_json, damaged, reshaped, with_words
from tests.attack.test_special_files import KINDS
from tests.attack.words import OF_JSON, OF_REPLAYS
from tests.support.packages import DEADLOCK
from tests.unit.explore.test_explore_scenarios import FOUND, SCENARIO
from tests.unit.live import recordings

# It is what asks for the version of rclpy, and starts nothing else.
STAND_IN = '#!/bin/sh\necho 7.1.6\n'
PROGRAM = '#!/bin/sh\ntouch {canary}\n'
SCHEDULE = Schedule(
    code='CC301',
    path='node.py',
    line=9,
    message='x and y overlap',
    entry='node.py',
    function='main',
    points=(Point(file='node.py', first=9, last=9), Point(file='node.py', first=12, last=13)),
    held=(Held(function='tick', file='node.py', line=20), Held(kind='client', key='/plan')),
    values=('go', 1, 2.5),
    forever=True,
    race=RacePlan(
        attribute='count',
        own=Lines(file='node.py', first=9, last=9),
        others=(Lines(file='node.py', first=12, last=12),),
    ),
    times_out_s=2.0,
)


def stand_in(canary: Path) -> Path:
    """An interpreter that says it has rclpy."""
    path = canary.parent / 'stand-in'
    if not path.exists():
        path.write_text(STAND_IN)
        path.chmod(0o755)
    return path


def beside(content: bytes, canary: Path) -> Callable[[Path], None]:
    """The file, a node, and programs that must not run."""

    def prepare(folder: Path) -> None:
        (folder / 'evil.json').write_bytes(content)
        (folder / 'node.py').write_text(DEADLOCK)
        for name in ('python3', 'python', 'ros2'):
            (folder / name).write_text(PROGRAM.format(canary=canary))
            (folder / name).chmod(0o755)

    return prepare


def changed(row: dict[str, Any], chance: random.Random, canary: Path) -> bytes:
    if chance.random() < 0.6:
        return as_json(reshaped(row, chance)).encode()
    text = json.dumps(row, indent=1)
    if chance.random() < 0.3:
        return damaged(text.encode(), chance)
    words = (*OF_JSON, *OF_REPLAYS)
    return with_words(text, words, chance).replace('CANARY', str(canary)).encode(errors='replace')


COMMANDS = (
    ['python', 'node.py'],
    ['./python3', 'node.py'],
    ['./python', '-m', 'x'],
    ['./ros2', 'run', 'a', 'b'],
    ['sh', '-c', 'touch CANARY'],
    ['./python3\n\x1b[2K\r\x1b[1Als'],
    [''],
    ['\0'],
    ['x' * 300_000],
)


def explore_schedules(chance: random.Random, canary: Path) -> Attempt:
    scenario = replace(SCENARIO, command=tuple(chance.choice(COMMANDS)))
    row = json.loads(write_found(FOUND, scenario, '7.1.6'))
    arguments = ['explore', '--replay', 'evil.json', '--output-format']
    arguments.append(chance.choice(('text', 'json')))
    if chance.random() < 0.25:
        ours = str(stand_in(canary))
        tree = reshaped(row, chance)
        content = as_json({**tree, 'command': [ours]} if isinstance(tree, dict) else tree).encode()
        arguments += ['--yes', '--python', ours, '--max-seconds', '2']
        return Attempt(tuple(arguments), beside(content, canary))
    if chance.random() < 0.6:
        arguments += ['--python', str(stand_in(canary))]
    text = changed(row, chance, canary).replace(b'CANARY', str(canary).encode())
    return Attempt(tuple(arguments), beside(text, canary))


def confirm_schedules(chance: random.Random, canary: Path) -> Attempt:
    schedule = replace(SCHEDULE, code=chance.choice(('CC101', 'CC107', 'CC111', 'CC301')))
    row = json.loads(write_schedule(schedule))
    content = changed(row, chance, canary)
    arguments = ['confirm', '--replay', 'evil.json', '--python', str(stand_in(canary))]
    arguments += ['--output-format', chance.choice(('text', 'json'))]
    if chance.random() < 0.5:
        arguments += ['--yes', '--limit', '1']
    return Attempt(tuple(arguments), beside(content, canary))


def recorded() -> dict[str, Any]:
    own = recordings
    return own.data(
        executors=[own.executor(1)],
        nodes=[own.node(2, 'arm', own.stay(1, 10, None))],
        groups=[own.group(3, node=2, default=True)],
        entities=[own.timer(4, 2, 3, 'arm.Arm.tick'), own.timer(5, 2, 3, 'arm.Arm.tock')],
    )


EVENTS = b''.join(
    recordings.event(n * 1000, 7 + n % 2, 'end' if n % 4 > 1 else 'begin', 4 + n % 2)
    for n in range(400)
)
WHY = (
    'hang-1',
    'exception-1',
    'signal-1',
    'signal-20',
    'last',
    '',
    '../../x',
    '[*',
    '\udcff',
    'é',
)
STEMS = ('7-1', '7-[1', '7-*', '7-1.flight-a', '.7')


def flight_records(chance: random.Random, canary: Path) -> Attempt:
    stem = chance.choice(STEMS) if chance.random() < 0.3 else STEMS[0]
    recording = recorded()
    if chance.random() < 0.2:
        recording = reshaped(recording, chance)
    names = [f'{stem}{turn}' for turn in TURNS]
    names += [f'{stem}{COPY}{why.replace("/", "_")}{RAW_SUFFIX}' for why in chance.sample(WHY, 3)]
    contents = {
        name: damaged(EVENTS, chance) if chance.random() < 0.6 else EVENTS for name in names
    }
    special = {n: chance.choice(sorted(KINDS)) for n in names if chance.random() < 0.1}

    has_folder = chance.random() < 0.1

    def prepare(folder: Path) -> None:
        live = folder / 'live'
        live.mkdir()
        (live / f'{stem}.json').write_text(as_json(recording), errors='replace')
        for name, content in contents.items():
            if name in special:
                KINDS[special[name]](live / name)
            else:
                (live / name).write_bytes(content)
        if has_folder:
            (live / f'{stem}{COPY}folder{RAW_SUFFIX}').mkdir()

    asked = (
        ('collect', 'live', '-o', 'out.yaml', '--trace', 'out.jsonl'),
        ('collect', 'live', '-o', 'out.yaml'),
        ('system', 'live', '--output-format', chance.choice(('yaml', 'html', 'dot'))),
        ('system', f'live/{stem}.json', '--output-format', 'mermaid'),
        ('diff', 'live', 'live'),
    )
    return Attempt(chance.choice(asked), prepare, ('out',))
