"""``spec --check``: the committed specification against the source as it is now."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.e2e.conftest import Outcome, Run

ARM = """import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.group = ReentrantCallbackGroup()
        self.count = 0
        self.create_subscription(String, 'joints', self.on_joints, 10)
        self.create_timer(0.5, self.tick, callback_group=self.group)

    def on_joints(self, message):
        pass

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Arm())
    executor.spin()


main()
"""


def check_after(run: Run, folder: Path, old: str, new: str) -> Outcome:
    """Commit the specification of the arm, change its source, and check."""
    source = folder / 'arm.py'
    source.write_text(ARM)
    assert run('spec', 'arm.py', '-o', 'arm.yaml').status == 0
    assert old in ARM
    source.write_text(ARM.replace(old, new))
    return run('spec', '--check', 'arm.yaml', 'arm.py')


@pytest.mark.parametrize(
    ('old', 'new'),
    [
        ('class Arm', '# moved\n\n\nclass Arm'),
        ('self.count = 0\n', 'self.count = (\n            0)\n'),
    ],
)
def test_moved_lines_are_no_drift(run: Run, tmp_path: Path, old: str, new: str) -> None:
    outcome = check_after(run, tmp_path, old, new)
    assert (outcome.status, outcome.out) == (0, 'no drift from arm.yaml\n')


@pytest.mark.parametrize(
    ('old', 'new', 'told'),
    [
        (
            ', callback_group=self.group',
            '',
            [
                'arm.py:14:9: arm: callback tick callback group was group, is arm_default',
            ],
        ),
        (
            'num_threads=2',
            'num_threads=3',
            [
                'arm.py:25:16: arm: executor number of threads was 2, is 3',
            ],
        ),
        (
            '(num_threads=2)',
            '()',
            [
                'arm.py:25:16: arm: executor number of threads was 2, is default_cpu_count',
            ],
        ),
        ('0.5', '2.0', ['arm.py:14:9: arm: callback tick period in seconds was 0.5, is 2.0']),
        (
            "'joints'",
            "'states'",
            [
                'arm.py:13:9: arm: callback on_joints key was joints, is states',
            ],
        ),
        (
            'def tick(self):\n        pass',
            'def tick(self):\n        self.count += 1',
            [
                'arm.py:14:9: arm: callback tick now writes Arm.count as an update',
            ],
        ),
        (
            "        self.create_subscription(String, 'joints', self.on_joints, 10)\n",
            '',
            [
                'arm.yaml: arm: callback on_joints is gone',
            ],
        ),
        (
            "super().__init__('arm')",
            "super().__init__('leg')",
            [
                'arm.py:25:16: leg: unit is new',
                'arm.yaml: arm: unit is gone',
            ],
        ),
    ],
    ids=['group', 'threads', 'default threads', 'period', 'topic', 'state', 'gone', 'node'],
)
def test_drift_is_told_in_words(
    run: Run, tmp_path: Path, old: str, new: str, told: list[str]
) -> None:
    outcome = check_after(run, tmp_path, old, new)
    assert outcome.status == 1
    assert [line for line in told if line not in outcome.out.splitlines()] == [], outcome.out
    assert outcome.err.endswith('to accept: ros2cc-extract spec arm.py -o arm.yaml\n')


def test_order_of_creation_is_part_of_the_contract(run: Run, tmp_path: Path) -> None:
    first = '        self.create_timer(0.5, self.tick, callback_group=self.group)\n'
    second = '        self.create_timer(2.0, self.tick)\n'
    source = tmp_path / 'arm.py'
    source.write_text(ARM.replace(first, first + second))
    run('spec', 'arm.py', '-o', 'arm.yaml')
    source.write_text(ARM.replace(first, second + first))
    outcome = run('spec', '--check', 'arm.yaml', 'arm.py')
    assert outcome.status == 1
    assert 'callback tick callback group was group, is arm_default' in outcome.out


def test_a_committed_file_that_is_missing_is_an_error(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'arm.py').write_text(ARM)
    outcome = run('spec', '--check', 'nowhere.yaml', 'arm.py')
    assert (outcome.status, outcome.out) == (2, '')
    assert outcome.err.startswith('ros2cc-extract: error: nowhere.yaml')
