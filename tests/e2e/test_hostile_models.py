"""Models that would never end, or fill the memory: each run is a process of its own, measured."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.support.published import document
from tests.support.small import automaton

NATIVE = 'ros2cc_extract.checker._core'
#: Python with the checker and its parser, and room for what is about to be refused.
FEW_MB = 120


@dataclass(frozen=True)
class Ended:
    """How a process ended."""

    status: int
    stdout: str
    stderr: str
    peak_mb: float


LAUNCHER = """
import os, sys
child = os.spawnv(os.P_NOWAIT, sys.argv[2], sys.argv[2:])
_, status, used = os.wait4(child, 0)
os.write(int(sys.argv[1]), b'%d' % used.ru_maxrss)
sys.exit(os.waitstatus_to_exitcode(status))
"""
"""Small itself: the peak memory of a process includes that of its parent."""


def run(path: Path, *options: str) -> Ended:
    command = [sys.executable, '-m', 'ros2cc_extract.cli.main', 'verify', str(path), *options]
    reader, writer = os.pipe()
    done = subprocess.run(
        [sys.executable, '-ISc', LAUNCHER, str(writer), *command],
        pass_fds=[writer],
        capture_output=True,
        text=True,
        check=False,
    )
    os.close(writer)
    with os.fdopen(reader) as used:
        return Ended(done.returncode, done.stdout, done.stderr, int(used.read()) / 1024)


def model(tmp_path: Path, drawing: str, declaration: str) -> Path:
    path = tmp_path / 'm.xml'
    text = document(declaration, automaton('P', drawing), 'system P;')
    path.write_text(text.replace('</queries>', QUERY + '</queries>'), encoding='utf-8')
    return path


QUERY = '<query><formula>A[] not deadlock</formula><comment></comment></query>'


@pytest.mark.parametrize(
    ('update', 'declaration', 'what'),
    [
        ('spin()', 'int x; void spin() { while (x == 0) { } }', 'spin runs through more than'),
        ('look()', 'int x = 3; bool a[3]; void look() { a[x]; }', 'index 3 is outside a'),
        ('a[x] = 1, x = 9', 'int[0, 9] x; int a[3];', 'index 9 is outside a'),
        ('x = x + 7', 'int[0, 9] x;', '14 is outside the range 0..9 of x'),
        ('x = x * 70000', 'int[1, 70000] x = 1;', 'does not fit into 32 bits'),
    ],
)
@pytest.mark.parametrize('engine', ['native', 'reference'])
def test_run_time_error_is_one_line(
    update: str, declaration: str, what: str, engine: str, tmp_path: Path
) -> None:
    if engine == 'native':
        pytest.importorskip(NATIVE, reason='the native core is not built')
    path = model(tmp_path, f'a\na -> a; do: {update}', declaration)
    ended = run(path, '--engine', engine)
    assert (ended.status, ended.stdout) == (2, '')
    assert what in ended.stderr
    assert ended.stderr.count('\n') == 1
    assert ended.peak_mb < FEW_MB


LAUGHS = ''.join(f'<!ENTITY l{k} "&l{k - 1};&l{k - 1};&l{k - 1};">' for k in range(1, 40))


@pytest.mark.parametrize(
    ('text', 'what'),
    [
        ('<nta>' * 1_000_000, 'XML elements nest deeper than 64'),
        (f'<!DOCTYPE n [<!ENTITY l0 "ha">{LAUGHS}]><nta>&l39;</nta>', "declares the entity 'l0'"),
        (document('int x = ' + '!' * 100_000 + '1;', '', 'system P;'), 'deeper than 100'),
        (document('int x[1000][1000][1000];', '', 'system P;'), 'more than 1000000 variables'),
    ],
)
def test_text_is_refused_before_it_fills_the_memory(text: str, what: str, tmp_path: Path) -> None:
    path = tmp_path / 'm.xml'
    path.write_text(text, encoding='utf-8')
    ended = run(path)
    assert (ended.status, ended.stdout) == (2, '')
    assert what in ended.stderr
    assert ended.stderr.count('\n') == 1
    assert ended.peak_mb < FEW_MB + 60


# 2^40 states: no machine has the room.
HUGE = 'a\na -> a; select: i : int[0, 39]; do: b[i] = !b[i]'


def test_limit_of_memory_is_kept_by_measurement(tmp_path: Path) -> None:
    pytest.importorskip(NATIVE, reason='the native core is not built')
    ended = run(model(tmp_path, HUGE, 'bool b[40];'), '--max-memory', '150')
    assert ended.status == 3
    assert 'the limit of 150 MB was reached' in ended.stdout
    assert ended.peak_mb < 150


@pytest.mark.parametrize('engine', ['native', 'reference'])
@pytest.mark.parametrize('count', [1, 2, 40, 41, 1000])
def test_limit_of_states_is_exact(engine: str, count: int, tmp_path: Path) -> None:
    if engine == 'native':
        pytest.importorskip(NATIVE, reason='the native core is not built')
    path = model(tmp_path, HUGE, 'bool b[40];')
    limits = '--max-states', str(count)
    ended = run(path, '--engine', engine, '--no-reduction', *limits, '--output-format', 'json')
    assert ended.status == 3
    assert f'"states": {count},' in ended.stdout
    assert f'the limit of {count} states was reached' in ended.stdout
