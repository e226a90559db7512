"""A scan says the same however many processes share it, and in whatever order files are given."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from tests.support.trees import write_tree

# In a process of its own: under some test runners threads run, and then nothing is forked.
PROGRAM = """
import sys
from pathlib import Path
from ros2cc_extract.jobs import process_pool
from ros2cc_extract.extract.static.api import scan

started = []
pool = process_pool.ProcessPool
start = pool._start_child
pool._start_child = lambda self, *given: (started.append(1), start(self, *given))
print(scan([Path(p) for p in sys.argv[2:]], processes=int(sys.argv[1])))
print(len(started), 'children', file=sys.stderr)
"""


def scanned(folder: Path, paths: Sequence[object], processes: int) -> tuple[str, str]:
    done = subprocess.run(
        [sys.executable, '-c', PROGRAM, str(processes), *map(str, paths)],
        cwd=folder,
        capture_output=True,
        check=True,
        text=True,
    )
    return done.stdout, done.stderr.strip()


def test_any_number_of_processes_gives_the_same(tmp_path: Path) -> None:
    write_tree(tmp_path)
    alone, children = scanned(tmp_path, ['.'], 1)
    assert children == '0 children'
    assert alone.count('Spec(name=') == 12
    assert scanned(tmp_path, ['.'], 2) == (alone, '2 children')
    assert scanned(tmp_path, ['.'], 5) == (alone, '5 children')


def test_any_order_of_arguments_gives_the_same(tmp_path: Path) -> None:
    files = [path.relative_to(tmp_path) for path in write_tree(tmp_path)]
    expected, _ = scanned(tmp_path, files, 2)
    assert scanned(tmp_path, files[::-1], 2)[0] == expected
    assert scanned(tmp_path, ['two', 'one', *files], 1)[0] == expected


def test_small_scans_stay_in_one_process(tmp_path: Path) -> None:
    (tmp_path / 'small.py').write_text('import rclpy\n')
    assert scanned(tmp_path, ['.'], 8)[1] == '0 children'
