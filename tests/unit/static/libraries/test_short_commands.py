"""A command that ends at once is no wait for a process outside."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import os
import subprocess
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Desk(Node):
    def __init__(self):
        super().__init__('desk')
        self.tool = os.environ['TOOL']
        self.create_subscription(String, 'order', self.on_order, 10)

    def on_order(self, msg):
        {}


rclpy.init()
rclpy.spin(Desk())
"""


def waits(does: str) -> list[str]:
    units = scan_text(PROGRAM.format(does)).units
    return [block.call for unit in units for each in unit.callbacks for block in each.blocking]


@pytest.mark.parametrize(
    'does',
    [
        "subprocess.run(['pkill', '-f', msg.data])",
        "subprocess.call(['/usr/bin/amixer', 'set', 'Master', f'{msg.data}%'])",
        "subprocess.check_output(['ip', 'addr'])",
        "subprocess.getoutput('hostname | tr'.split(' |')[0])",
        "os.system('mkdir -p /tmp/maps && rm -f /tmp/maps/old.yaml')",
        "os.system('pkill -f player > /dev/null 2>&1; rm /tmp/now')",
        "subprocess.call(args='shutdown -h now', shell=True)",
        "subprocess.run(['kill' if msg.data else 'pgrep', '1'])",
    ],
)
def test_a_short_command_is_no_wait(does: str) -> None:
    assert waits(does) == []


@pytest.mark.parametrize(
    'does',
    [
        "subprocess.run(['killall', '--wait', 'player'])",
        "subprocess.run(['espeak', 'hello'])",
        "subprocess.run(['ip', 'monitor'])",
        "subprocess.run(['v4l2-ctl', '--stream-mmap'])",
        "subprocess.run(['sudo', 'reboot'])",  # may ask for a password
        "subprocess.run([self.tool, 'ls'])",
        'subprocess.run([self.tool])',
        'subprocess.run(msg.data.split())',
        "subprocess.run(['ls' if msg.data else 'espeak', '1'])",
    ],
)
def test_another_command_is_one(does: str) -> None:
    assert waits(does) == ['subprocess.run']


@pytest.mark.parametrize(
    'line',
    [
        'ls; espeak hello',
        'echo $(cat)',
        'mkdir maps && ping base',
        'ls | less',
        'ls `cat`',
        'ls "',
        'ls &; cat',
        '',
    ],
)
def test_a_line_of_the_shell_is_short_where_all_of_it_is(line: str) -> None:
    assert waits(f'os.system({line!r})') == ['os.system']
