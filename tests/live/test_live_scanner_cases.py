"""
Every scanner case that real rclpy can run holds there what the scanner says of its source.

Each runs until it holds that and makes nothing new: a sample every time, all with ``-m slow``.
"""

from __future__ import annotations

import io
import re
import signal
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from _pytest.mark import ParameterSet
from child import Child
from conftest import ROOT
from interpreters import EVERY_RELEASE_AT_LEISURE, interpreter_of

from ros2cc_extract.compare.merge import Difference, diff
from ros2cc_extract.extract.live.recordings.collect import specs_of
from ros2cc_extract.extract.live.run import read_directory
from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.spec.model import Spec

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
# Of so many cases one is run every time.
SAMPLED = 14
# A case that holds what is expected is set up when it has not changed for as many looks as this;
# one that does not may be slow.
QUIET_LOOKS, LOOKS = 15, 1000
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


def specs_in(folder: Path) -> tuple[Spec, ...]:
    recordings = read_directory(folder, io.StringIO())
    return tuple(spec for recording in recordings for spec in specs_of(recording))


def differences(scanned: Sequence[Spec], live: Sequence[Spec]) -> list[Difference]:
    return [each for each in diff(scanned, live) if not each.marked]


def record_until_quiet(child: Child, folder: Path, scanned: Sequence[Spec]) -> tuple[Spec, ...]:
    """
    Record a program until it holds what is expected and makes nothing new, then end it.

    One that never holds it is given ``LOOKS`` looks without anything new, and one that ends by
    itself no more than it takes.
    """
    seen: list[int] = []

    def is_quiet() -> bool:
        live = specs_in(folder)
        held = sum(len(spec.callbacks) for spec in live)
        if seen and held != seen[-1]:
            seen.clear()
        seen.append(held)
        if child.process.poll() is not None or (live and len(seen) >= LOOKS):
            return True
        return bool(live) and len(seen) >= QUIET_LOOKS and not differences(scanned, live)

    child.wait_for(is_quiet)
    child.process.send_signal(signal.SIGINT)
    try:
        child.process.wait(END_WITHIN_S)
    except subprocess.TimeoutExpired:
        child.process.kill()
    return specs_in(folder)


def marked_cases() -> list[ParameterSet]:
    """All cases; the sample is run every time."""
    return [
        pytest.param(*case, marks=() if number % SAMPLED == 0 else pytest.mark.slow)
        for number, case in enumerate(runnable_cases())
    ]


@pytest.fixture(scope='module', params=EVERY_RELEASE_AT_LEISURE)
def rclpy_python(request: pytest.FixtureRequest) -> str:
    """Give an interpreter for each release that is there."""
    return interpreter_of(request.param)


@pytest.mark.parametrize(('case', 'entry'), marked_cases())
def test_case_holds_what_the_scanner_says(
    case: str, entry: str, start: Callable[..., Child], tmp_path: Path
) -> None:
    child = start(RUN_ENTRY, str(CASES / case), entry, recorded_into=tmp_path)
    units = scan([CASES / case]).units
    mine = [unit for unit in units if (unit.entry or '').rpartition(':')[2] in ('', entry)]
    live = record_until_quiet(child, tmp_path, mine)
    assert live, child.text
    assert differences(mine, live) == []
