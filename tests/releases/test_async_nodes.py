"""
Nodes that asyncio runs, good and bad: what was observed, and what is said of them.

No model has their loop, so nothing of them is promised. What is certain is found, and a good one
is never warned of. The last lines of a node say what 10.0.10 and 11.0.0 do, and which rule warns.
"""

from __future__ import annotations

import subprocess
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main
from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of
from tests.conformance.suite import own_environment
from tests.releases.turns import release_of_the_day

NODES = sorted(Path(__file__).with_name('async_nodes').glob('*.py'))
PATIENCE_S = 10.0
LINES_WITH_ASYNC_NODES = ('10.', '11.')

every_node = pytest.mark.parametrize('path', NODES, ids=lambda path: path.stem)


def told_of(path: Path) -> dict[str, str]:
    """What the last lines say."""
    lines = path.read_text().splitlines()[-2:]
    return dict(line.removeprefix('# ').split(': ', 1) for line in lines)


@every_node
def test_what_is_certain_is_warned_of_and_nothing_else(path: Path) -> None:
    extraction = scan_text(path.read_text(), path.name)
    found = findings_of(extraction.units, extraction.diagnostics)
    codes = [each.code for each in found if each.severity in (Severity.WARNING, Severity.ERROR)]
    assert (', '.join(codes) or 'nothing') == told_of(path)['warned of']


@every_node
def test_nothing_is_promised(path: Path) -> None:
    out = StringIO()
    main([str(path)], out, StringIO())
    shown = out.getvalue()
    assert '  ? no deadlock' in shown
    assert '✓' not in shown


@pytest.mark.live
def test_they_do_as_observed() -> None:
    python, release = release_of_the_day()
    if not release.version.startswith(LINES_WITH_ASYNC_NODES):
        pytest.skip(f'rclpy {release.version} has no AsyncNode')
    assert {path.stem: observed(python, path, release.over({})) for path in NODES} == {
        path.stem: told_of(path)['observed'] for path in NODES
    }


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
    return 'raises' if status else 'goes on' if 'goes on' in out else 'hangs'
