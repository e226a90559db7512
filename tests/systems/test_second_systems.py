"""
Systems that were run for real, by the real launch, before the tool was asked of them.

Their last lines say who was observed and what is found; ``by_launch.py`` runs them. On Jazzy and
Kilted each bad one stands still, and each good one goes on.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.systems.by_launch import SECOND, Running, launch_files
from tests.systems.test_systems import expected, found_in


@pytest.mark.parametrize('path', launch_files(), ids=lambda path: path.name)
def test_a_system_has_the_findings_that_it_names(path: Path) -> None:
    found, wanted = found_in(path, below=SECOND), expected(path)
    assert [each[:2] for each in found] == [each[:2] for each in wanted]
    assert all(want in has for (_, _, has), (_, _, want) in zip(found, wanted, strict=True))


def test_the_process_that_was_started_first_is_observed(tmp_path: Path) -> None:
    """Of two of one program either may speak first."""
    log = tmp_path / 'log'
    log.write_text(
        '[INFO] [ticker.py-2]: process started with pid [8]\n'
        '[INFO] [ticker.py-1]: process started with pid [7]\n'
        '[ticker.py-2] asks\n[ticker.py-1] asks\n[ticker.py-2] goes on\n',
        encoding='utf-8',
    )
    path = SECOND / 'launch' / 'clock_bad.launch.py'
    with subprocess.Popen(['true'], text=True) as process:
        running = Running(path, process, 0.0, log)
    assert (list(running.lines()), running.count()) == (['asks'], 0)


SENDS_REPLIES = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Clerk(Node):
    def __init__(self):
        super().__init__('clerk')
        self.replies = self.create_publisher(String, 'replies', 10)
        self.create_timer(1.0, self.reply)

    def reply(self):
        self.replies.publish(String())


rclpy.init()
rclpy.spin(Clerk())
"""
CLERK = '<node pkg="second" exec="clerk.py"/>'


def test_a_message_that_comes_from_beside_the_circle_ends_a_wait(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    below = tmp_path / 'second'
    shutil.copytree(SECOND, below)
    monkeypatch.chdir(below)
    path = below / 'launch' / 'ordered_by_topic_bad.launch.xml'
    (below / 'programs' / 'clerk.py').write_text(SENDS_REPLIES, encoding='utf-8')
    text = path.read_text(encoding='utf-8').replace('</group>', f'{CLERK}</group>')
    path.write_text(text, encoding='utf-8')
    assert found_in(path, below=below) == []
