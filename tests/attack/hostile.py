"""
Hostile inputs of each class, drawn by number: files, and the command that reads them.

What is valid is made once and then damaged; what a stranger would bring in is mixed with it.
``CANARY`` in a text is replaced by the path of a file that only executed code would make.
"""

from __future__ import annotations

import json
import random
import shutil
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

import yaml

from ros2cc_extract.extract.live.recorder.events import RAW_SUFFIX
from tests.attack.arena import Attempt
from tests.attack.bombs import bomb
from tests.attack.hostile_replays import (
    confirm_schedules,
    explore_schedules,
    flight_records,
    recorded,
)
from tests.attack.hostile_systems import (
    json_systems,
    launch_bombs,
    launch_files,
    system_specs,
    workspaces,
)
from tests.attack.mutations import as_json, damaged, reshaped, with_words
from tests.attack.repositories import ATTACKS
from tests.attack.test_special_files import KINDS
from tests.attack.words import (
    BASES,
    OF_JSON,
    OF_PYTHON,
    OF_QUERIES,
    OF_SETTINGS,
    OF_TOML,
    OF_XML,
    OF_YAML,
    RUNS,
)
from tests.property.test_scanner_fuzz import TEXTS
from tests.support.packages import DEADLOCK
from tests.support.repositories import commit, make_repository
from tests.unit.conform.test_conform_command import SPEC, trace_lines
from tests.unit.live import recordings

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / 'launch_free_examples'
MODELS = (*(ROOT / 'tests/models').glob('*.xml'), *(ROOT / 'tests/golden/models').glob('*/*.xml'))
QUERIES = sorted((ROOT / 'tests/golden/models').glob('*/*.q'))
SMALL = ('--timeout', '1', '--max-states', '20000', '--max-memory', '400')
Draw = Callable[[random.Random, Path], Attempt]
"""By chance, for a canary."""


def writing(**contents: str | bytes) -> Callable[[Path], None]:
    """Write files; ``__`` in a name stands for a dot."""

    def prepare(folder: Path) -> None:
        for name, content in contents.items():
            is_text = isinstance(content, str)
            data = content.encode('utf-8', 'surrogatepass') if is_text else content  # type: ignore[union-attr]
            (folder / name.replace('__', '.')).write_bytes(data)  # type: ignore[arg-type]

    return prepare


def text_of(content: str, words: Sequence[str], chance: random.Random, canary: Path) -> bytes:
    """Half of them of lines and words, some of bytes."""
    if chance.random() < 0.25:
        return damaged(content.encode(), chance)
    text = with_words(content, words, chance).replace('CANARY', str(canary))
    return text.encode('utf-8', 'surrogatepass')


def json_of(tree: object, chance: random.Random, canary: Path) -> bytes:
    if chance.random() < 0.6:
        return as_json(reshaped(tree, chance)).encode()
    return text_of(json.dumps(tree, indent=1), OF_JSON, chance, canary)


def sources(chance: random.Random, canary: Path) -> Attempt:
    text = text_of(chance.choice(TEXTS), OF_PYTHON, chance, canary)
    line = f'{chance.choice(RUNS)}\n'.replace('CANARY', str(canary)).encode()
    command = chance.choice(
        ('check', 'check', 'spec', 'spec', 'spec', 'model', 'verify', 'upgrade', 'system')
    )
    more = {
        'check': ('--timeout', '2', '--no-cache'),
        'verify': SMALL,
        'model': ('-o', 'out'),
        'upgrade': ('--from', 'jazzy', '--to', 'kilted'),
    }
    return Attempt(
        (command, '.' if command == 'system' else 'node.py', *more.get(command, ())),
        writing(node__py=line + text if chance.random() < 0.8 else text + b'\n' + line),
        ('out',),
    )


def bombs(chance: random.Random, canary: Path) -> Attempt:
    """The search has a limit of its own, and is asked to keep one."""
    arguments = ('check', 'node.py', '--no-cache', '--timeout', '2')
    return Attempt(arguments, writing(node__py=bomb(chance)))


@cache
def specifications() -> tuple[str, ...]:
    paths = (*EXAMPLES.glob('*/expected.spec.yaml'), *ROOT.glob('tests/golden/models/*/spec.yaml'))
    return (*(path.read_text() for path in sorted(paths)), SPEC)


def specs(chance: random.Random, canary: Path) -> Attempt:
    good = chance.choice(specifications())
    if chance.random() < 0.5:
        evil = yaml.safe_dump(reshaped(next(yaml.safe_load_all(good)), chance)).encode(
            errors='replace'
        )
    else:
        evil = text_of(good, OF_YAML, chance, canary)
    arguments = chance.choice(
        (
            ('verify', 'evil.yaml', *SMALL),
            ('verify', 'evil.yaml', '--profile', 'rclpy', *SMALL),
            ('model', 'evil.yaml', '-o', 'out'),
            ('model', 'evil.yaml', '-o', 'out', '--profile', 'rclpy'),
            ('diff', 'good.yaml', 'evil.yaml'),
            ('merge', 'good.yaml', 'evil.yaml'),
            ('conform', 'trace.jsonl', 'evil.yaml'),
        )
    )
    files = writing(good__yaml=good, evil__yaml=evil, trace__jsonl='\n'.join(trace_lines()))
    return Attempt(arguments, files, ('out',))


def models(chance: random.Random, canary: Path) -> Attempt:
    text = text_of(chance.choice(MODELS).read_text(), OF_XML, chance, canary)
    return Attempt(('verify', 'evil.xml', *SMALL), writing(evil__xml=text))


def queries(chance: random.Random, canary: Path) -> Attempt:
    own = chance.choice(QUERIES)
    model = chance.choice(sorted(own.parent.glob('*.xml')))
    text = text_of(own.read_text(), OF_QUERIES, chance, canary)
    files = writing(model__xml=model.read_bytes(), evil__q=text)
    return Attempt(('verify', 'model.xml', 'evil.q', *SMALL), files)


def traces(chance: random.Random, canary: Path) -> Attempt:
    lines = trace_lines()
    if chance.random() < 0.6:
        rows = reshaped([json.loads(line) for line in lines], chance)
        text = '\n'.join(map(as_json, rows if isinstance(rows, list) else [rows])).encode()
    else:
        text = text_of('\n'.join(lines), OF_JSON, chance, canary)
    files = writing(evil__jsonl=text, arm__yaml=SPEC)
    return Attempt(('conform', 'evil.jsonl', 'arm.yaml', '--max-states', '20000'), files)


def baselines(chance: random.Random, canary: Path) -> Attempt:
    entry = {'fingerprint': 'ab' * 16, 'code': 'CC101', 'path': 'node.py', 'message': 'x'}
    good = {'ros2cc_baseline': 1, 'findings': [entry, {**entry, 'code': 'CC301'}]}
    files = writing(node__py=DEADLOCK, evil__json=json_of(good, chance, canary))
    return Attempt(('check', 'node.py', '--baseline', 'evil.json'), files)


TABLE = """\
[build-system]
requires = []
[tool.ros2cc]
ignore = ["CC3", "CC501"]
per_path = {"tests/**" = ["CC1"]}
assume = ["threads=2"]
baseline = "known.json"
timeout = 5.0
docs_url = "https://example.org/x"
never_together = [["tick", "on_joint"]]
never_starves = ["tick"]
"""


def configurations(chance: random.Random, canary: Path) -> Attempt:
    text = text_of(TABLE, OF_TOML, chance, canary)
    known = '{"ros2cc_baseline": 1, "findings": []}'
    files = writing(node__py=DEADLOCK, pyproject__toml=text, known__json=known)
    return Attempt(('check', 'node.py'), files)


def recordings_of(chance: random.Random, canary: Path) -> Attempt:
    raw = b''.join(recordings.event(n * 1000, 7, 'begin', 4) for n in range(40))
    is_raw = chance.random() < 0.3
    evil = json.dumps(recorded()).encode() if is_raw else json_of(recorded(), chance, canary)
    events = damaged(raw, chance) if is_raw else raw

    def prepare(folder: Path) -> None:
        live = folder / 'live'
        live.mkdir()
        (live / '7-1.json').write_bytes(evil)
        (live / f'7-1.json{RAW_SUFFIX}').write_bytes(events)

    arguments = ('collect', 'live', '-o', 'out.yaml', '--trace', 'out.jsonl')
    return Attempt(arguments, prepare, ('out',))


def make_base(folder: Path) -> None:
    """Two commits."""
    make_repository(folder)
    (folder / 'node.py').write_text(DEADLOCK)
    commit(folder, 'start')
    (folder / 'node.py').write_text(f'# moved\n{DEADLOCK}')
    commit(folder, 'move')
    shutil.rmtree(folder / '.git' / 'hooks', ignore_errors=True)


SCENES = [name for name, attack in ATTACKS.items() if not attack.environment]
PARTS = (
    'config',
    'config',
    'config',
    'HEAD',
    'index',
    'refs',
    'objects',
    'objects',
    'packed-refs',
    'info/attributes',
    'config.worktree',
    'commondir',
    'shallow',
    'info/grafts',
    'objects/info/alternates',
)


def git_configurations(chance: random.Random, canary: Path) -> Attempt:
    base, kept = canary.parent / 'repository', canary.parent / 'program'
    if not base.exists():
        make_base(base)
        kept.write_text(f'#!/bin/sh\ntouch {canary}\n')
        kept.chmod(0o755)
    revision = chance.choice(BASES) if chance.random() < 0.3 else 'HEAD~1'

    def prepare(folder: Path) -> None:
        shutil.copytree(base, folder, dirs_exist_ok=True, symlinks=True)
        for _ in range(chance.randint(1, 2)):
            part = folder / '.git' / chance.choice(PARTS)
            if part.is_dir():
                part = chance.choice(sorted(path for path in part.rglob('*') if path.is_file()))
                part.chmod(0o644)
            before = part.read_bytes() if part.exists() else b''
            if chance.random() < 0.5:
                word = chance.choice(OF_SETTINGS).replace('CANARY', str(canary))
                part.write_bytes(before + b'\n' + word.encode() + b'\n')
            else:
                part.write_bytes(damaged(before, chance))

    arguments = ('check', 'node.py', f'--diff-base={revision.replace("CANARY", str(canary))}')
    return Attempt(arguments, prepare)


NAMES = (
    'node.py',
    '__init__.py',
    'setup.py',
    'setup.cfg',
    'package.xml',
    'pyproject.toml',
    'evil.json',
    'evil.yaml',
    'evil.xml',
    'evil.q',
    'rclpy.py',
    '.git',
    '.gitignore',
    'evil.jsonl',
    'evil.launch.xml',
    'evil.launch.yaml',
    'evil.launch.py',
    'CMakeLists.txt',
)
READERS: tuple[tuple[str, ...], ...] = (
    ('check', '.'),
    ('check', 'node.py'),
    ('check', 'clean.py', '--baseline', 'evil.json'),
    ('check', 'clean.py', '--diff-base', 'HEAD'),
    ('spec', '.', '--strict'),
    ('spec', '--check', 'evil.yaml', 'clean.py'),
    ('verify', 'evil.xml', *SMALL),
    ('verify', 'model.xml', 'evil.q', *SMALL),
    ('verify', 'evil.yaml', *SMALL),
    ('model', 'evil.yaml', '-o', 'out'),
    ('merge', 'clean.py', 'evil.yaml'),
    ('diff', 'clean.py', 'evil.yaml'),
    ('conform', 'evil.jsonl', 'clean.py'),
    ('collect', '.', '-o', 'out.yaml'),
    ('init', '.'),
    ('system', '.'),
    ('system', 'evil.launch.xml'),
    ('system', 'evil.launch.yaml', 'evil.launch.py'),
    ('system', 'evil.yaml'),
    ('check', 'evil.launch.py'),
    ('diff', '.', 'evil.yaml'),
    ('upgrade', '--from', 'jazzy', '--to', 'kilted', '.'),
    ('fleet', '.', '-o', 'out'),
    ('explore', '--replay', 'evil.json'),
    ('confirm', '--replay', 'evil.json'),
)
FIFOS = {'evil.yaml'}
"""What is named as a specification may be a pipe, and is waited for then."""


def special_files(chance: random.Random, canary: Path) -> Attempt:
    names = chance.sample(NAMES, chance.randint(1, 4))
    kinds = {name: chance.choice(sorted(KINDS)) for name in names}
    for name in FIFOS & kinds.keys():
        kinds[name] = kinds[name].replace('fifo', 'device')

    def prepare(folder: Path) -> None:
        (folder / 'clean.py').write_text(DEADLOCK)
        shutil.copy(ROOT / 'tests/models/peterson.xml', folder / 'model.xml')
        for name, kind in kinds.items():
            KINDS[kind](folder / name)

    return Attempt(chance.choice(READERS), prepare, ('out', '.pre-commit', '.github', 'test'))


CLASSES: dict[str, tuple[Draw, int, int]] = {
    'sources': (sources, 12, 1_200),
    'sources that explode': (bombs, 4, 150),
    'specifications': (specs, 10, 700),
    'UPPAAL models': (models, 8, 500),
    'queries': (queries, 8, 400),
    'traces': (traces, 10, 400),
    'baselines': (baselines, 6, 250),
    'configurations': (configurations, 6, 300),
    'recordings': (recordings_of, 10, 400),
    'flight records': (flight_records, 10, 400),
    'schedules of explore': (explore_schedules, 10, 300),
    'schedules of confirm': (confirm_schedules, 10, 300),
    'launch files in XML': (launch_files('.xml'), 10, 400),
    'launch files in YAML': (launch_files('.yaml'), 10, 400),
    'launch files in Python': (launch_files('.py'), 10, 400),
    'launch files that explode': (launch_bombs, 4, 150),
    'workspaces': (workspaces, 8, 300),
    'systems': (system_specs, 10, 400),
    'systems in JSON': (json_systems, 6, 200),
    'git configurations': (git_configurations, 6, 300),
    'special files': (special_files, 8, 400),
}
"""How each is drawn, how many in continuous integration, how many of record."""


def drawn(kind: str, number: int, canary: Path) -> Attempt:
    """The same attempt for the same number, whatever came before."""
    return CLASSES[kind][0](random.Random(f'{kind} {number}'), canary)
