"""A file of a schedule runs nothing before somebody has said that it may: not its interpreter."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from ros2cc_extract.confirm.schedules import write_schedule
from ros2cc_extract.explore.scenario import write_found
from tests.attack.hostile_replays import PROGRAM, SCHEDULE
from tests.attack.running import run_tool
from tests.unit.explore.test_explore_scenarios import FOUND, SCENARIO

CLASS = 'consent'
NOBODY = 'is not started: nobody was asked, as this is no terminal'


@pytest.mark.parametrize(
    'program', ['python3', './python3', 'sub/python3.11', 'ros2', 'ls\n\x1b[2K']
)
def test_a_replay_asks_before_anything_of_the_file_runs(program: str, tmp_path: Path) -> None:
    canary = tmp_path / 'canary'
    folder = tmp_path / 'input'
    path = folder / program.replace('\n', '')
    path.parent.mkdir(parents=True)
    path.write_text(PROGRAM.format(canary=canary))
    path.chmod(0o755)
    scenario = replace(SCENARIO, command=(program, 'node.py'))
    (folder / 'evil.json').write_text(write_found(FOUND, scenario, None))
    search = f'.:{Path("/usr/bin")}'
    done = run_tool('explore', '--replay', 'evil.json', cwd=folder, PATH=search)
    assert not canary.exists()
    assert (done.status, NOBODY in done.err) == (2, True), done
    assert done.err.count('\n') <= 2 and '\x1b' not in done.err


def test_confirm_asks_before_the_program_of_a_file_runs(tmp_path: Path) -> None:
    canary = tmp_path / 'canary'
    (tmp_path / 'evil.py').write_text(f'open({str(canary)!r}, "w")')
    python = tmp_path / 'python3'
    python.write_text('#!/bin/sh\necho 7.1.6\n')
    python.chmod(0o755)
    row = json.loads(write_schedule(SCHEDULE)) | {'entry': 'evil.py'}
    (tmp_path / 'evil.json').write_text(json.dumps(row))
    done = run_tool('confirm', '--replay', 'evil.json', '--python', python, cwd=tmp_path)
    assert not canary.exists()
    assert (done.status, NOBODY in done.err) == (2, True), done
