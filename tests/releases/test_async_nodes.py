"""
Nodes that asyncio runs, good and bad: what was observed, and what is said of them.

The last lines of a node say what 10.0.10 and 11.0.0 do, which rules warn, and which promises are
broken or undecided. A good one is never warned of and breaks no promise; of a bad one something is
said. ``docs/asyncnode.md`` shows the same in a table.
"""

from __future__ import annotations

import re
import subprocess
from concurrent.futures import ThreadPoolExecutor
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main
from ros2cc_extract.findings.promises import Promise
from tests.conformance.suite import own_environment
from tests.releases.turns import release_of_the_day

FOLDER = Path(__file__).with_name('async_nodes')
NODES = sorted(FOLDER.glob('*.py'))
PAGE = Path(__file__).parents[2] / 'docs' / 'asyncnode.md'
PATIENCE_S = 15.0
AT_A_TIME = 3
LINES_WITH_ASYNC_NODES = ('10.', '11.')
GOOD, NOTHING = 'goes on', 'nothing'
#: What happens is said by no rule: the program is to end so.
MEANT = {'raises_bad'}
#: What being cancelled does to a callback is not followed (``docs/asyncnode.md``).
NOT_FOUND = {'cancelled_task_bad', 'swallowed_bad'}

every_node = pytest.mark.parametrize('path', NODES, ids=lambda path: path.stem)


def told_of(path: Path) -> dict[str, str]:
    """What the last lines say."""
    lines = path.read_text().splitlines()[-4:]
    return dict(line.removeprefix('# ').split(': ', 1) for line in lines)


def checked(path: Path) -> str:
    """What a user reads."""
    out = StringIO()
    main([str(path)], out, StringIO())
    return out.getvalue()


def warned_of(shown: str) -> str:
    found = re.findall(r'^\S+:\d+:\d+: (?:error|warning) (CC\d+)', shown, re.MULTILINE)
    return ', '.join(dict.fromkeys(found)) or NOTHING


def promises(shown: str, mark: str) -> str:
    """The promises that have a mark."""
    names = '|'.join(promise.value for promise in Promise)
    first = {name: sign for sign, name in reversed(re.findall(rf'([✓✗?]) ({names})', shown))}
    assert first.keys() == {promise.value for promise in Promise}
    having = (promise.value for promise in Promise if first[promise.value] == mark)
    return ', '.join(having) or NOTHING


@every_node
def test_what_a_check_says_of_a_node(path: Path) -> None:
    shown, told = checked(path), told_of(path)
    assert told == {
        'observed': told['observed'],
        'warned of': warned_of(shown),
        'broken': promises(shown, '✗'),
        'undecided': promises(shown, '?'),
    }


def test_good_nodes_are_not_warned_of_and_bad_ones_are_spoken_of() -> None:
    told = {path.stem: told_of(path) for path in NODES}
    silent = {'warned of': NOTHING, 'broken': NOTHING, 'undecided': NOTHING}
    for name, lines in told.items():
        is_good = lines['observed'] == GOOD
        assert name.endswith('_good' if is_good else '_bad')
        if is_good:
            assert (lines['warned of'], lines['broken']) == (NOTHING, NOTHING), name
        elif name not in MEANT | NOT_FOUND:
            assert {key: lines[key] for key in silent} != silent, name


def test_the_page_has_what_was_observed() -> None:
    rows = re.findall(r'^\| `(\w+)` \| ([^|]*) \| ([^|]*) \|', PAGE.read_text(), re.MULTILINE)
    assert {name: (seen, said) for name, seen, said in rows} == {
        path.stem: (told_of(path)['observed'], _in_words(told_of(path))) for path in NODES
    }


def _in_words(told: dict[str, str]) -> str:
    """What the page says of the findings and verdicts of a node."""
    if told['warned of'] != NOTHING:
        return told['warned of']
    return 'undecided' if told['undecided'] != NOTHING else 'no finding'


@pytest.mark.live
def test_they_do_as_observed() -> None:
    python, release = release_of_the_day()
    if not release.version.startswith(LINES_WITH_ASYNC_NODES):
        pytest.skip(f'rclpy {release.version} has no AsyncNode')
    more = release.over({})
    with ThreadPoolExecutor(AT_A_TIME) as pool:
        seen = list(pool.map(lambda path: observed(python, path, more), NODES))
    told = {path.stem: told_of(path)['observed'] for path in NODES}
    assert dict(zip(told, seen, strict=True)) == told


def observed(python: str, path: Path, more: dict[str, str]) -> str:
    """How the callback that asks ends."""
    with own_environment() as environment:
        ran = subprocess.Popen(
            [python, str(path)],
            env={**environment, **more},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        try:
            out, _ = ran.communicate(timeout=PATIENCE_S)
        except subprocess.TimeoutExpired:
            ran.kill()
            out, _ = ran.communicate()
            status = 0
        else:
            status = ran.returncode
    assert 'asks' in out, f'{path.stem} has not begun: {out}'
    if status:
        return 'raises'
    return next((words for words in ('loses', 'late', GOOD) if words in out), 'hangs')
