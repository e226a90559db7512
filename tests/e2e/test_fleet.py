"""Many repositories in one call."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import jsonschema
import pytest

from tests.e2e.conftest import EXAMPLES, ROOT, Run, environment
from tests.support.knots import write_knots
from tests.support.repositories import git

SCHEMA = json.loads((ROOT / 'ros2cc_extract/report/machine/check.schema.json').read_text())
NAMES = ('service_deadlock', 'two_groups', 'pool_exhaustion')


@pytest.fixture
def fleet(tmp_path: Path) -> list[str]:
    """Repositories of one node each, in the working folder."""
    for name in NAMES:
        (tmp_path / name).mkdir()
        text = (EXAMPLES / name / 'node.py').read_text(encoding='utf-8')
        (tmp_path / name / 'node.py').write_text(text, encoding='utf-8')
    return list(NAMES)


def states(out: str) -> dict[str, str]:
    """Of each row of the table its name and its end."""
    rows = [line.split(maxsplit=7) for line in out.splitlines()[1:-1]]
    return {row[0]: row[7] for row in rows if len(row) == 8 and ':' not in row[0]}


def test_each_repository_has_the_result_of_its_own_check(
    run: Run, fleet: list[str], tmp_path: Path
) -> None:
    told = run('fleet', *fleet, '-o', 'results')
    assert (told.status, told.err) == (1, '')
    assert states(told.out) == dict.fromkeys(fleet, 'checked')
    assert sorted(path.name for path in (tmp_path / 'results').iterdir()) == sorted(
        f'{name}.json' for name in fleet
    )
    for name in fleet:
        data = json.loads((tmp_path / 'results' / f'{name}.json').read_text())
        jsonschema.validate(data, SCHEMA)
        origin = data.pop('origin')
        assert (origin['folder'], origin['complete']) == (name, True)
        alone = run(name, '--output-format', 'json')
        assert data == json.loads(alone.out)


def test_the_table_ends_in_one_line_for_all(run: Run, fleet: list[str]) -> None:
    rows = run('fleet', *fleet, '-o', 'results').out.splitlines()
    assert rows[0].split() == [
        *('repository', 'files', 'units', 'errors', 'warnings', 'notes', 'undecided', 'result'),
    ]
    assert rows[1].split() == ['service_deadlock', '1', '1', '1', '0', '1', '0', 'checked']
    assert rows[-1].startswith('Found ')
    assert rows[-1].endswith(' in 3 of 3 repositories')


def test_what_has_not_changed_is_not_checked_again(
    run: Run, fleet: list[str], tmp_path: Path
) -> None:
    first = run('fleet', *fleet, '-o', 'results')
    path = tmp_path / 'results' / 'two_groups.json'
    before = path.stat().st_mtime_ns
    node = tmp_path / 'service_deadlock' / 'node.py'
    node.write_text(node.read_text() + '\n')
    again = run('fleet', *fleet, '-o', 'results')
    assert states(again.out) == dict.fromkeys(fleet, 'unchanged') | {'service_deadlock': 'checked'}
    assert (path.stat().st_mtime_ns, again.status) == (before, first.status)
    assert again.out.splitlines()[-1] == first.out.splitlines()[-1]
    (tmp_path / 'two_groups' / 'pyproject.toml').write_text('[tool.ros2cc]\nignore = ["CC4"]\n')
    assert states(run('fleet', *fleet, '-o', 'results').out)['two_groups'] == 'checked'
    for more in (['--threads', 3], ['--no-cache']):
        others = states(run('fleet', *fleet, '-o', 'results', *more).out)
        assert others == dict.fromkeys(fleet, 'checked')


def test_a_clone_names_its_commit(run: Run, fleet: list[str], tmp_path: Path) -> None:
    for command in (['init'], ['add', '.'], ['commit', '-m', 'first']):
        assert git(tmp_path / fleet[0], *command).returncode == 0
    run('fleet', *fleet, '-o', 'results')
    head = git(tmp_path / fleet[0], 'rev-parse', 'HEAD').stdout.strip()
    found = [
        json.loads((tmp_path / 'results' / f'{name}.json').read_text())['origin']['revision']
        for name in fleet
    ]
    assert found == [head, None, None]


def test_a_repository_that_fails_does_not_end_the_others(
    run: Run, fleet: list[str], tmp_path: Path
) -> None:
    (tmp_path / 'empty').mkdir()
    (tmp_path / 'odd').mkdir()
    (tmp_path / 'odd' / 'pyproject.toml').write_text('[tool.ros2cc]\nunknown = 1\n')
    told = run('fleet', 'empty', 'odd', *fleet, '-o', 'results')
    assert told.status == 2
    found = states(told.out)
    assert (found.pop('empty'), found.pop('odd')) == ('failed', 'failed')
    assert found == dict.fromkeys(fleet, 'checked')
    first, second = told.out.splitlines()[-3:-1]
    assert first == 'empty: empty: no Python file in this directory'
    assert second.startswith('odd: ') and "'unknown'" in second
    assert not (tmp_path / 'results' / 'empty.json').exists()


def test_repositories_of_one_name_are_told_apart(run: Run, tmp_path: Path) -> None:
    for owner in ('a', 'b'):
        (tmp_path / owner / 'robot').mkdir(parents=True)
        (tmp_path / owner / 'robot' / 'x.py').write_text('')
    told = run('fleet', 'a/robot', 'b/robot', '-o', 'results')
    assert told.status == 0
    assert list(states(told.out)) == ['a+robot', 'b+robot']
    assert {path.name for path in (tmp_path / 'results').iterdir()} == {
        'a+robot.json',
        'b+robot.json',
    }
    twice = run('fleet', 'a/robot', 'a/../a/robot', '-o', 'results')
    assert (twice.status, 'is given twice' in twice.err) == (2, True)
    none = run('fleet', 'a/robot', 'nowhere', '-o', 'results')
    assert (none.status, 'nowhere is no folder' in none.err) == (2, True)


def test_the_time_is_one_for_all_and_the_next_call_goes_on(
    run: Run, fleet: list[str], tmp_path: Path
) -> None:
    for number in range(3):
        (tmp_path / f'hard_{number}').mkdir()
        write_knots(tmp_path / f'hard_{number}', 12)
    hard = [f'hard_{number}' for number in range(3)]
    run('fleet', *fleet, '-o', 'results')
    for _ in range(2):
        told = run('fleet', *fleet, *hard, '-o', 'results', '--max-seconds', 3)
        found = states(told.out)
        assert told.status == 1
        assert {found[name] for name in fleet} == {'unchanged'}
        assert {found[name] for name in hard} <= {'cut', 'not reached'}
        assert told.out.splitlines()[-1].split('; ')[0].endswith(' in 3 of 6 repositories')
    for path in (tmp_path / 'results').glob('hard_*.json'):
        assert json.loads(path.read_text())['origin']['complete'] is False


@pytest.mark.parametrize(('number', 'status'), [(signal.SIGTERM, 143), (signal.SIGINT, 130)])
def test_who_ends_it_keeps_what_is_done(
    number: int, status: int, fleet: list[str], tmp_path: Path, cache: Path
) -> None:
    for hard in ('hard_0', 'hard_1'):
        (tmp_path / hard).mkdir()
        write_knots(tmp_path / hard, 60)
    names = [*fleet, 'hard_0', 'hard_1']
    child = subprocess.Popen(
        [sys.executable, '-m', 'ros2cc_extract.cli.main', 'fleet', *names, '-o', 'results'],
        cwd=tmp_path,
        env=environment(cache),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    give_up = time.monotonic() + 60
    while not all((tmp_path / 'results' / f'{name}.json').exists() for name in fleet):
        assert child.poll() is None
        assert time.monotonic() < give_up
        time.sleep(0.05)
    os.killpg(child.pid, number)
    out, err = child.communicate(timeout=60)
    assert (child.returncode, err) == (
        status,
        'interrupted: the same call goes on from here\n',
    )
    expected = dict.fromkeys(fleet, 'checked') | {'hard_0': 'not reached', 'hard_1': 'not reached'}
    assert states(out) == expected
