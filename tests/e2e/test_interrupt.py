"""A Ctrl-C while a model is searched, at whatever instruction it arrives."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.published import document
from tests.support.small import automaton

# 2^40 states; the queries that one of the first states answers stay answered.
DRAWING = 'a\na -> a; select: i : int[0, 39]; do: b[i] = !b[i]'
PROGRAM = """
import sys
from pathlib import Path
from ros2cc_extract.checker.api import EngineKind, Query, check, load_model

def progress(known):
    if known.states > 500:
        print('searching', flush=True)

model = load_model(Path(sys.argv[1]))
queries = [Query(formula, '', None) for formula in ('E<> b[3]', 'A[] not deadlock')]
result = check(model, queries, engine=EngineKind(sys.argv[2]), reduction=False, progress=progress)
print(*((answer.verdict.value, answer.reason) for answer in result.answers))
"""


@pytest.mark.parametrize('engine', ['native', 'reference'])
@pytest.mark.parametrize('try_', range(3))
def test_search_ends_with_what_is_known(engine: str, try_: int, tmp_path: Path) -> None:
    if engine == 'native':
        pytest.importorskip('ros2cc_extract.checker._core', reason='the native core is not built')
    path = tmp_path / 'm.xml'
    path.write_text(
        document('bool b[40];', automaton('P', DRAWING), 'system P;'), encoding='utf-8'
    )
    child = subprocess.Popen(
        [sys.executable, '-c', PROGRAM, str(path), engine],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert child.stdout is not None
    assert child.stdout.readline() == 'searching\n'
    child.send_signal(signal.SIGINT)
    stdout, stderr = child.communicate(timeout=300)
    assert stderr == ''
    last = stdout.splitlines()[-1]
    assert last == "('satisfied', None) ('undecided', 'interrupted')"
