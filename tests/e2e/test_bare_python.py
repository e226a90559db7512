"""On a Python with less of an operating system below it, as in a browser: the same findings."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.e2e.conftest import EXAMPLES, Run, environment

# What Pyodide 314 does not have, though its platform is a POSIX one.
WITHOUT = """
import os, signal, sys
sys.platform = 'emscripten'
for module in ('resource', 'pwd', '_multiprocessing'):
    sys.modules[module] = None
for name in ('geteuid', 'getuid', 'sched_getaffinity'):
    delattr(os, name)
del signal.setitimer
from pathlib import Path
from ros2cc_extract.checker.engines import limits
limits._STATM = limits._MEMINFO = Path('/proc/nowhere')
from ros2cc_extract.cli.main import main
sys.exit(main(sys.argv[1:], sys.stdout, sys.stderr))
"""
PLAIN = ('check', 'node.py', '--engine', 'reference', '--no-cache')


def bare(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, '-c', WITHOUT, *arguments]
    return subprocess.run(
        command, cwd=folder, env=environment(folder), capture_output=True, text=True, timeout=120
    )


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    shutil.copy(EXAMPLES / 'service_deadlock' / 'node.py', tmp_path)
    return tmp_path


def test_the_same_is_found(folder: Path, run: Run) -> None:
    told, done = run(*PLAIN), bare(folder, *PLAIN)
    assert (done.returncode, done.stdout, done.stderr) == (1, told.out, told.err)


def test_a_limit_on_memory_that_nobody_counts_leaves_verdicts_open(folder: Path) -> None:
    done = bare(folder, *PLAIN, '--max-memory', '1000', '--verdicts')
    assert (
        'undecided (there is a limit on memory, but memory cannot be measured here)' in done.stdout
    )
    assert 'in 1 file; 21 verdicts undecided' in done.stdout
