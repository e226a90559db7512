"""Every subcommand in every environment: its result, or one line and the right status."""

from __future__ import annotations

import random
import shutil
from functools import cache
from pathlib import Path

import pytest

from tests.attack.conftest import Tally
from tests.attack.environments import (
    ENVIRONMENTS,
    NOBODY,
    SUBCOMMANDS,
    Surroundings,
    fill,
    is_possible,
)
from tests.attack.running import Ended, assert_orderly, run_tool

CLASS = 'environments'
ENV = str(shutil.which('env'))
COMBINED = 150
LINE = 'ros2cc-extract: '


@cache
def usual(subcommand: str, base: Path) -> Ended:
    return ended(subcommand, Surroundings(), base / 'for comparison' / subcommand)


def ended(subcommand: str, surroundings: Surroundings, folder: Path) -> Ended:
    fill(folder)
    temporary = folder.parent / 'temporary'
    temporary.mkdir(exist_ok=True)
    temporary.chmod(0o1777)
    variables = {'TMPDIR': str(temporary), **surroundings.variables}
    prefix = surroundings.prefix or (ENV,)  # by which Python itself starts it
    done = run_tool(*SUBCOMMANDS[subcommand], cwd=folder, prefix=prefix, **variables)
    assert_orderly(done)
    assert list(temporary.iterdir()) == []
    return done


@pytest.fixture(scope='module')
def base(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp('environments')
    made.parent.chmod(0o755)
    made.chmod(0o755)
    return made


ALL = [(name, subcommand) for name in ENVIRONMENTS for subcommand in SUBCOMMANDS]
SHORT = range(0, len(ALL), len(SUBCOMMANDS) + 1)
"""In continuous integration each environment is seen with one subcommand, each with another."""


@pytest.mark.parametrize(
    ('name', 'subcommand'),
    [
        pytest.param(*case, marks=() if number in SHORT else pytest.mark.slow)
        for number, case in enumerate(ALL)
    ],
)
def test_a_subcommand_in_an_environment(
    name: str, subcommand: str, base: Path, tmp_path: Path
) -> None:
    if not is_possible(name):
        pytest.skip('such an environment cannot be made here')
    surroundings, before = ENVIRONMENTS[name], usual(subcommand, base)
    done = ended(subcommand, surroundings, base / name / subcommand)
    if done.status == before.status:
        return
    assert surroundings.changes, (done, before)
    assert done.status == 2 or (done.status, name) == (0, 'a reader that leaves'), done
    if done.status == 2 and name != 'nothing open':
        assert done.err.splitlines()[-1].startswith(LINE), done


def _at_once(names: list[str]) -> list[str]:
    """A process that has become another user cannot do so again."""
    strangers = [name for name in names if NOBODY[0] in ENVIRONMENTS[name].prefix]
    return [name for name in names if name not in strangers[1:]]


@pytest.mark.slow
def test_environments_together(base: Path, tally: Tally) -> None:
    chance = random.Random(1)
    # Without programs nobody would find those that make the others.
    names = [name for name in ENVIRONMENTS if is_possible(name) and name != 'no programs']
    for number in range(COMBINED):
        chosen = _at_once(chance.sample(names, 3))
        subcommand = chance.choice(list(SUBCOMMANDS))
        each = [ENVIRONMENTS[name] for name in chosen]
        # What a stranger may not do any more comes before.
        each.sort(key=lambda one: (NOBODY[0] in one.prefix, not one.as_root))
        together = Surroundings(
            tuple(word for one in each for word in one.prefix),
            {key: value for one in each for key, value in one.variables.items()},
        )
        tally.add()
        fill_and_run = base / f'together {number}' / 'package'
        done = Ended(0, '', '')
        try:
            done = ended(subcommand, together, fill_and_run)
        except AssertionError as error:
            raise AssertionError(f'{chosen} {subcommand}: {error}') from error
        assert done.status in (0, 1, 2, 3)
