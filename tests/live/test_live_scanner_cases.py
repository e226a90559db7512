"""
Every scanner case that real rclpy can run holds there what the scanner says of its source.

A long suite (``-m slow``): each case runs for as long as it takes to set itself up.
"""

from __future__ import annotations

import io
import re
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from child import Child
from conftest import ROOT

from ros2cc_extract.extract.live.collect import specs_of
from ros2cc_extract.extract.live.recording import Recording
from ros2cc_extract.extract.live.run import read_directory
from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.merge import diff

CASES = ROOT / 'tests' / 'scanner_cases'
RUN_ENTRY = Path(__file__).with_name('programs') / 'run_entry.py'
ENTRY = re.compile(r'^# unit [^:]+: .*, (\w+)$', re.MULTILINE)
# What a run that is ended after its set-up cannot show, or shows otherwise.
LEFT_OUT = {
    'p15_asks_first_then_spins.py': 'it waits for an answer that nobody gives',
    'p47_nodes_in_sequence.py': 'the second node is spun when the first has ended',
    'p52_nested_spin_of_another_node.py': 'the global executor serves the inner node as well',
    'q17_no_executor.py': 'there is no executor',
}
# A case is set up when it has not changed for as many looks as this.
QUIET_LOOKS = 15
END_WITHIN_S = 5.0


def runnable_cases() -> list[tuple[str, str]]:
    """Name each case that can run, with the function that its expectation starts at."""
    found = []
    for path in sorted(CASES.glob('*.py')):
        text = path.read_text(encoding='utf-8')
        entries = set(ENTRY.findall(text)) - {'__main__'}
        if '# live: no' not in text and path.name not in LEFT_OUT:
            found += [(path.name, entry) for entry in sorted(entries)]
    return found


def record_until_quiet(child: Child, folder: Path) -> tuple[Recording, ...]:
    """Record a program until it ends or makes nothing new, then end it."""
    seen: list[int] = []

    def is_quiet() -> bool:
        recordings = read_directory(folder, io.StringIO())
        held = any(map(specs_of, recordings))
        seen.append(sum(len(each.entities) for each in recordings) if held else -len(seen))
        last = seen[-QUIET_LOOKS:]
        return child.process.poll() is not None or (
            held and len(last) == QUIET_LOOKS and len(set(last)) == 1
        )

    child.wait_for(is_quiet)
    child.process.send_signal(signal.SIGINT)
    try:
        child.process.wait(END_WITHIN_S)
    except subprocess.TimeoutExpired:
        child.process.kill()
    return tuple(read_directory(folder, io.StringIO()))


@pytest.mark.slow
@pytest.mark.parametrize(('case', 'entry'), runnable_cases())
def test_case_holds_what_the_scanner_says(
    case: str, entry: str, start: Callable[..., Child], tmp_path: Path
) -> None:
    child = start(RUN_ENTRY, str(CASES / case), entry, recorded_into=tmp_path)
    recordings = record_until_quiet(child, tmp_path)
    live = tuple(spec for recording in recordings for spec in specs_of(recording))
    assert live, child.text
    units = scan([CASES / case]).units
    mine = [unit for unit in units if (unit.entry or '').rpartition(':')[2] in ('', entry)]
    assert [each for each in diff(mine, live) if not each.marked] == []
