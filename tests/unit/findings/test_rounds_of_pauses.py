"""CC201, CC208, *no starvation*: pauses of loops whose rounds are not known, or end by a time."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path
from textwrap import indent

import pytest

from ros2cc_extract.cli.main import main

NODE = """\
import select
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Store:
    BLOCK = 64

    def __init__(self, wait):
        self.wait = wait
        self.rows = []

    def put(self, block):
        time.sleep({pause})

    def save(self, data):
{work}


class Map(Node):
    def __init__(self):
        super().__init__('map')
        self.store = Store({wait})
        self.data = b''
        self.is_left = False
        self.create_timer({period}, self.beat, callback_group={others})
        self.create_service(Trigger, 'save', self.on_save, callback_group={group})
        self.create_timer(0.7, self.look, callback_group={group})

    def beat(self):
        self.get_logger().info('beat')

    def look(self):
        {look}

    def on_save(self, request, response):
        self.store.save(self.data[len(str(time.time())):])
        return response


def main():
    rclpy.init()
    executor = {executor}
    executor.add_node(Map())
    executor.spin()


main()
"""
BLOCKS = 'for at in range(0, len(data), self.BLOCK):\n    self.put(data[at:])'
ROWS = 'for row in data:\n    self.put(row)'
LEFT = 'at = 0\nwhile at < len(data):\n    self.put(data[at:])\n    at += self.BLOCK'
THREE = 'for row in range(3):\n    self.put(row)'
UNTIL = """\
end = time.time() + self.wait
while {}time.time() < end:
    ready, _, _ = select.select([0], [], [], 0.05)
    if ready:
        self.rows.append(data)"""
SLEEPS = """\
end = time.time() + self.wait
while {}time.time() < end:
    self.put(data)"""
MORE = 'len(data) < 10 and '
ONE, POOL = 'SingleThreadedExecutor()', 'MultiThreadedExecutor(4)'
OWN, ALL = 'MutuallyExclusiveCallbackGroup()', 'ReentrantCallbackGroup()'


def report(
    folder: Path,
    work: str,
    *,
    pause: float = 0.1,
    wait: float = 1.5,
    period: float = 0.1,
    executor: str = ONE,
    group: str = 'None',
    others: str = 'None',
    look: str = 'pass',
) -> tuple[list[str], str]:
    """What CC2xx says, and the mark and the reason of *no starvation*."""
    text = NODE.format(
        work=indent(work, ' ' * 8),
        pause=pause,
        wait=wait,
        period=period,
        executor=executor,
        group=group,
        others=others,
        look=look,
    )
    path, out = folder / 'way.py', StringIO()
    path.write_text(text, encoding='utf-8')
    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, StringIO())
    found = json.loads(out.getvalue())
    (unit,) = found['promises']
    said = {each['promise']: each for each in unit['promises']}['no starvation']
    codes = [f'{f["code"]} {f["message"]}' for f in found['findings'] if f['code'] < 'CC3']
    return codes, f'{said["mark"]} {said.get("reason", "")}'


@pytest.mark.parametrize('work', [BLOCKS, ROWS, LEFT])
@pytest.mark.parametrize('executor', [ONE, POOL])
def test_how_often_it_sleeps_is_not_known(work: str, executor: str, tmp_path: Path) -> None:
    found, starvation = report(tmp_path, work, executor=executor)
    assert found == []
    assert starvation == (
        'undecided Map.on_save sleeps 0.1 s in each round of a loop (way.py:19), how often is '
        'not known'
    )


@pytest.mark.parametrize(
    ('pause', 'executor', 'group', 'others'),
    [
        (0.1, POOL, ALL, OWN),  # the group holds nobody up
        (0.0001, ONE, 'None', 'None'),  # as short as other work
    ],
)
@pytest.mark.parametrize('work', [BLOCKS, ROWS, LEFT])
def test_where_nobody_waits_nothing_is_open(
    pause: float, executor: str, group: str, others: str, work: str, tmp_path: Path
) -> None:
    found, starvation = report(
        tmp_path, work, pause=pause, executor=executor, group=group, others=others
    )
    assert (found, starvation) == ([], 'kept ')


@pytest.mark.parametrize('period', [0.1, 0.3])
def test_a_known_number_of_rounds_is_counted(period: float, tmp_path: Path) -> None:
    assert report(tmp_path, THREE, period=period) == ([], 'kept ')


@pytest.mark.parametrize('test', ['', MORE])
@pytest.mark.parametrize('work', [UNTIL, SLEEPS])
def test_a_loop_until_a_time_lasts_that_long(work: str, test: str, tmp_path: Path) -> None:
    (message,) = report(tmp_path, work.format(test))[0]
    assert message.startswith('CC201 Map.on_save ')
    assert '(1.5 s in all)' in message


@pytest.mark.parametrize('test', ['', MORE])
@pytest.mark.parametrize('work', [UNTIL, SLEEPS])
def test_a_short_one_is_not_told(work: str, test: str, tmp_path: Path) -> None:
    found, starvation = report(tmp_path, work.format(test), wait=0.2, period=0.3)
    assert (found, starvation) == ([], 'kept ')


READS = 'select.select([0], [], [], {})'


@pytest.mark.parametrize(('seconds', 'codes'), [(0.9, ['CC208']), (0.5, [])])
def test_a_read_that_nothing_comes_for_holds_up_others(
    seconds: float, codes: list[str], tmp_path: Path
) -> None:
    found, starvation = report(tmp_path, 'pass', look=READS.format(seconds), period=0.3)
    assert [each[:5] for each in found] == codes
    assert all('while nothing comes within the time-out of select.select' in f for f in found)
    assert starvation.startswith('undecided CC208' if codes else 'kept')


def test_one_that_holds_up_itself_alone_is_not_told(tmp_path: Path) -> None:
    look = READS.format(0.9)
    found, starvation = report(tmp_path, 'pass', look=look, executor=POOL, others=OWN, group=OWN)
    assert (found, starvation) == ([], 'kept ')
