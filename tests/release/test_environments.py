"""What a release runs for hours leaves what it said, however it ends."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from release.environments import watched

ROOT = Path(__file__).parents[2]
# Says a line, and before it ends it lets its own starter be killed.
KILLS_ITS_STARTER = """
import os, signal
print('one failed', flush=True)
os.kill(os.getppid(), signal.SIGKILL)
"""
STARTER = """
import sys
from pathlib import Path
from release.environments import watched
watched([sys.executable, '-c', sys.argv[1]], Path(sys.argv[2]), Path.cwd())
"""


def test_the_last_line_and_the_end_are_told(tmp_path: Path) -> None:
    output = tmp_path / 'output'
    for status, passed in ((0, True), (3, False)):
        program = f'print("first"); print("2 passed"); raise SystemExit({status})'
        given = watched([sys.executable, '-c', program], output, tmp_path)
        assert given == (passed, f'2 passed; see {output}')
    assert watched([sys.executable, '-c', ''], output, tmp_path) == (
        True,
        f'no output; see {output}',
    )


def test_what_was_said_before_a_run_was_cut_is_kept(tmp_path: Path) -> None:
    output = tmp_path / 'output'
    command = [sys.executable, '-c', STARTER, KILLS_ITS_STARTER, str(output)]
    assert subprocess.run(command, cwd=ROOT).returncode == -9
    assert output.read_text(encoding='utf-8') == 'one failed\n'
