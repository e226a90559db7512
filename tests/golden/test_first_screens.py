"""What a check prints first, on terminals and in logs; renewed as tests/golden/README.md says."""

from __future__ import annotations

import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import termios
from collections.abc import Mapping
from pathlib import Path

import pytest

from tests.support.starting import TOOL, run_command

ROOT = Path(__file__).parents[2]
SCREENS = Path(__file__).parent / 'screens'
EXAMPLES = ('service_deadlock', 'pool_exhaustion', 'two_groups', 'paper_case1')
CLEAN = 'default_group_only'
BROKEN = """\
import rclpy


def main(:
    rclpy.init()
"""
UNITS = 40
NODE = """\
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class Robot{n}(Node):
    def __init__(self):
        super().__init__('robot_{n}')
        self.beats = 0
        self.free = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'ready_{n}')
        self.create_timer(0.5, self.drive)
        self.create_subscription(Empty, 'beat_{n}', self.on_beat, 10{group})

    def drive(self):
        {work}

    def on_beat(self, message):
        {more}


def main():
    rclpy.init()
    executor = {executor}
    executor.add_node(Robot{n}())
    executor.spin()


if __name__ == '__main__':
    main()
"""
KINDS = (
    {'work': 'pass', 'more': 'pass', 'executor': 'SingleThreadedExecutor()', 'group': ''},
    {
        'work': 'self.client.call(Trigger.Request())',
        'more': 'pass',
        'executor': 'MultiThreadedExecutor(num_threads=2)',
        'group': '',
    },
    {
        'work': 'self.beats += 1',
        'more': 'self.beats += 1',
        'executor': 'MultiThreadedExecutor(num_threads=2)',
        'group': ', callback_group=self.free',
    },
    {'work': 'pass', 'more': 'pass', 'executor': 'make_executor()', 'group': ''},
)


@pytest.fixture(scope='module')
def repository(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp('repository')
    for number in range(UNITS):
        text = NODE.format(n=number, **KINDS[number % len(KINDS)])
        (folder / f'robot_{number:02}.py').write_text(text, encoding='utf-8')
    return folder


def environment(**more: str) -> Mapping[str, str]:
    left_out = ('COLUMNS', 'NO_COLOR', 'FORCE_COLOR', 'TERM')
    return {n: v for n, v in os.environ.items() if n not in left_out} | more


def in_a_log(folder: Path, path: str, columns: int, **more: str) -> str:
    done = run_command([path], cwd=folder, env=environment(COLUMNS=str(columns), **more))
    assert done.returncode in (0, 1, 2), done.stderr
    assert done.stderr == b''
    return done.stdout.decode()


def on_a_terminal(folder: Path, path: str, columns: int, **more: str) -> str:
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack('HHHH', 50, columns, 0, 0))
    child = subprocess.Popen(
        [*TOOL, path],
        cwd=folder,
        env=environment(TERM='xterm-256color', **more),
        stdin=subprocess.DEVNULL,
        stdout=theirs,
        stderr=subprocess.DEVNULL,
    )
    os.close(theirs)
    said = b''
    try:
        while part := os.read(ours, 65536):
            said += part
    except OSError:  # the end of what a terminal gets
        pass
    finally:
        os.close(ours)
        child.wait()
    return said.decode().replace('\r\n', '\n')


def compared(name: str, screen: str) -> None:
    """Compare a screen with the recorded one, or record it."""
    path = SCREENS / f'{name}.txt'
    if os.environ.get('RENEW_GOLDEN'):
        path.write_text(screen, encoding='utf-8')
    assert screen == path.read_text(encoding='utf-8')


@pytest.mark.parametrize('columns', [80, 120])
@pytest.mark.parametrize('example', [*EXAMPLES, CLEAN])
def test_of_an_example(example: str, columns: int) -> None:
    screen = in_a_log(ROOT, f'launch_free_examples/{example}/node.py', columns)
    compared(f'{example}_{columns}', screen)


@pytest.mark.parametrize('columns', [80, 120])
def test_of_a_broken_file(tmp_path: Path, columns: int) -> None:
    (tmp_path / 'broken.py').write_text(BROKEN, encoding='utf-8')
    screen = in_a_log(tmp_path, 'broken.py', columns)
    version = f'Python than {sys.version_info[0]}.{sys.version_info[1]}'
    compared(f'broken_{columns}', screen.replace(version, 'Python than 3.X'))


@pytest.mark.parametrize('columns', [80, 120])
def test_of_a_repository_of_40_units(repository: Path, columns: int) -> None:
    screen = in_a_log(repository, '.', columns)
    compared(f'repository_{columns}', screen)
    lines = screen.splitlines()
    begin = next(n for n, line in enumerate(lines) if line.startswith('checked '))
    assert len(lines) - begin <= 40
    assert all(len(line) <= columns for line in lines[begin:])


def test_the_screen_of_the_readme_has_24_lines() -> None:
    screen = in_a_log(ROOT, 'launch_free_examples/service_deadlock/node.py', 160)
    assert len(screen.splitlines()) <= 24


@pytest.mark.parametrize(('name', 'more'), [('colour', {}), ('no_colour', {'NO_COLOR': '1'})])
def test_of_the_readme_on_a_terminal(name: str, more: dict[str, str]) -> None:
    path = 'launch_free_examples/service_deadlock/node.py'
    said = on_a_terminal(ROOT, path, 80, **more)
    links = re.findall(r'\x1b\]8;id=[-\d]+;(\S+?)\x1b\\', said)
    assert set(links) == {(ROOT / path).as_uri()}
    told = re.sub(r'\x1b\]8;[^\x1b]*\x1b\\', '', said)
    told = re.sub(r'\(\d+\.\d s\)', '(0.0 s)', told)
    # The oldest rich that is allowed gives the end of a line the colour of the line.
    told = told.replace('\x1b[1m\n\x1b[0m', '\n')
    assert ('\x1b[1;31m' in told or '\x1b[31m' in told) is (name == 'colour')
    compared(f'terminal_{name}', told.replace('\x1b', '\\e'))


def test_a_log_that_asks_for_colours_gets_them() -> None:
    path = 'launch_free_examples/service_deadlock/node.py'
    said = in_a_log(ROOT, path, 80, FORCE_COLOR='1', TERM='xterm-256color')
    shown = (SCREENS / 'terminal_colour.txt').read_text(encoding='utf-8').replace('\\e', '\x1b')
    told = re.sub(r'\x1b\]8;[^\x1b]*\x1b\\', '', said)
    told = told.replace('\x1b[1m\n\x1b[0m', '\n')
    assert told == shown.replace(' (0.0 s)', '')
