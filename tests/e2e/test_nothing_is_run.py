"""What is scanned is not run, but where somebody has said that it may be."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.e2e.conftest import Run

NODE = """\
from pathlib import Path

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

Path({canary!r}).touch()


class Caller(Node):
    def __init__(self):
        super().__init__('caller')
        self.client = self.create_client(Trigger, 'answer')
        self.create_timer(0.1, self.ask)

    def ask(self):
        self.client.call(Trigger.Request())


def main():
    rclpy.init()
    rclpy.spin(Caller())


if __name__ == '__main__':
    main()
"""


@pytest.fixture
def canary(tmp_path: Path) -> Path:
    """What the node makes as soon as it is imported."""
    return tmp_path / 'was-run'


@pytest.fixture
def node(tmp_path: Path, canary: Path) -> Path:
    path = tmp_path / 'node.py'
    path.write_text(NODE.format(canary=str(canary)), encoding='utf-8')
    return path


def test_no_command_that_reads_runs_what_it_reads(
    node: Path, canary: Path, tmp_path: Path, run: Run
) -> None:
    spec = tmp_path / 'node.spec.yaml'
    assert run('check', node).status == 1
    scanned = run('spec', node)
    assert scanned.status == 0
    spec.write_text(scanned.out, encoding='utf-8')
    assert run('model', node, '-o', tmp_path / 'models').status == 0
    assert run('verify', spec, '--profile', 'rclpy').status == 0
    assert not canary.exists()


def test_confirm_asks_before_it_starts_a_node(
    node: Path, canary: Path, tmp_path: Path, run: Run
) -> None:
    python = tmp_path / 'python'
    python.write_text(f'#!/bin/sh\ncase "$1" in -c) echo 7.1.6;; *) touch {canary};; esac\n')
    python.chmod(0o755)
    refused = run('confirm', node, '--python', python)
    assert (refused.status, refused.out) == (2, '')
    assert 'is not started: nobody was asked, as this is no terminal; add --yes' in refused.err
    refused = run('check', node, '--confirm', '--python', python)
    assert refused.status == 2
    assert 'is not started: nobody was asked' in refused.err
    assert not canary.exists()
    assert run('confirm', node, '--python', python, '--yes', '--limit', '5').status == 0
    assert canary.exists(), 'the canary would have sung'


def test_explore_asks_before_it_runs_a_command(
    node: Path, canary: Path, tmp_path: Path, run: Run
) -> None:
    python = tmp_path / 'python'
    python.write_text(f'#!/bin/sh\ncase "$1" in -c) echo 7.1.6;; *) touch {canary};; esac\n')
    python.chmod(0o755)
    refused = run('explore', '--', python, node)
    assert (refused.status, refused.out) == (2, '')
    assert 'is not started: nobody was asked, as this is no terminal; add --yes' in refused.err
    assert not canary.exists()
    empty = run('explore', '--yes', '--', python, node)
    assert empty.status == 2
    assert 'no process of the command has loaded rclpy.executors, and it said' in empty.err
    assert canary.exists(), 'the canary would have sung'


def test_explore_says_what_it_lacks(node: Path, tmp_path: Path, run: Run) -> None:
    assert 'one command after --, or --replay' in run('explore').err
    both = run('explore', '--replay', node, '--', 'true')
    assert (both.status, both.out) == (2, '')
    assert 'one command after --, or --replay' in both.err
    assert 'is no schedule that explore has written' in run('explore', '--replay', node).err
    gone = run('explore', '--', tmp_path / 'python3', node)
    assert gone.status == 2 and 'cannot be started' in gone.err


def test_confirm_says_what_it_lacks(node: Path, run: Run) -> None:
    lacking = run('confirm', node, '--python', '/no/such/python')
    assert lacking.status == 2
    assert '/no/such/python cannot be started' in lacking.err


def test_confirm_names_the_findings_that_are_there(node: Path, tmp_path: Path, run: Run) -> None:
    python = tmp_path / 'python'
    python.write_text('#!/bin/sh\necho 7.1.6\n')
    python.chmod(0o755)
    asked = run('confirm', node, 'CC111', '--python', python, '--yes')
    assert asked.status == 2
    assert 'has no finding CC111; there are: CC102:17' in asked.err
