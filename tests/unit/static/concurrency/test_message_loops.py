"""Loops that only simulated time ends, which stands still until ``/clock`` is taken."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.api import scan

NODE = """\
import threading
import time

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import Trigger


class Walker(Node):
    def __init__(self):
        super().__init__('walker'{given})
        self.clock = self.get_clock()
        self.limit = 2.0
        self.stop = False
        self.create_service(Trigger, 'walk', self.on_walk)
{set_up}

    def time_is_up(self, start):
        return self.elapsed(start) > self.limit

    def elapsed(self, start):
        return (self.clock.now() - start).nanoseconds / 1e9

    def on_walk(self, request, response):
{walk}
        return response


def main():
    rclpy.init()
    rclpy.spin(Walker())


main()
"""
SIMULATED = ", parameter_overrides=[rclpy.Parameter('use_sim_time', value=True)]"
BY_TYPE = ", parameter_overrides=[Parameter('use_sim_time', Parameter.Type.BOOL, True)]"
START = 'start = self.get_clock().now()'
LOOPS = [
    ['while self.get_clock().now().nanoseconds == 0:', '    time.sleep(0.1)'],
    ['while not self.clock.now().nanoseconds:', '    pass'],
    [START, 'while (self.get_clock().now() - start).nanoseconds < 2e9:', '    time.sleep(0.1)'],
    [START, 'while self.clock.now() - start < Duration(seconds=2.0):', '    print(1)'],
    [
        'end = self.get_clock().now() + Duration(seconds=2)',
        'while rclpy.ok() and self.get_clock().now() < end:',
        '    time.sleep(0.1)',
    ],
    [START, 'while not self.time_is_up(start):', '    time.sleep(0.1)'],
    [START, 'while True:', '    if self.elapsed(start) > 2.0:', '        break'],
    [START, 'now = start', 'while now == start:', '    now = self.get_clock().now()'],
]


def _scanned(tmp_path: Path, given: str, set_up: list[str], walk: list[str]) -> Extraction:
    path = tmp_path / 'walker.py'
    shown = ['\n'.join(8 * ' ' + line for line in lines) for lines in (set_up, walk)]
    path.write_text(NODE.format(given=given, set_up=shown[0], walk=shown[1]))
    return scan([path])


@pytest.mark.parametrize('given', [SIMULATED, BY_TYPE])
@pytest.mark.parametrize('loop', LOOPS)
def test_in_a_callback_such_a_loop_waits_for_the_subscription_of_the_clock(
    tmp_path: Path, loop: list[str], given: str
) -> None:
    (unit,) = _scanned(tmp_path, given, ['pass'], loop).units

    (walk,) = [each for each in unit.callbacks if each.name == 'on_walk']
    (wait,) = [each for each in walk.blocking if each.call == 'polling loop']
    (clock,) = [each for each in unit.callbacks if each.name == 'clock_callback']
    assert wait.on == 'clock_callback' and wait.seconds is None
    assert {waker.by for waker in wait.wakers} == {'clock_callback', 'outside'}
    assert clock.group == walk.group


@pytest.mark.parametrize('loop', LOOPS)
def test_before_the_spin_nothing_moves_the_clock(tmp_path: Path, loop: list[str]) -> None:
    found = _scanned(tmp_path, SIMULATED, loop, ['pass'])

    (told,) = [each for each in found.diagnostics if each.slug == 'nobody-spins']
    assert told.message == (
        'a polling loop waits for simulated time while nothing spins the node that must take it: '
        'it waits forever'
    )


def test_what_else_ends_the_loop_is_a_waker_beside_the_clock(tmp_path: Path) -> None:
    loop = [START, 'while not self.stop and not self.time_is_up(start):', '    time.sleep(0.1)']
    subscribed = 'self.create_timer(1.0, lambda: setattr(self, "stop", True))'

    (unit,) = _scanned(tmp_path, SIMULATED, [subscribed], loop).units

    (walk,) = [each for each in unit.callbacks if each.name == 'on_walk']
    (wait,) = [each for each in walk.blocking if each.call == 'polling loop']
    assert 'clock_callback' in {waker.by for waker in wait.wakers}
    assert 'outside' not in {waker.by for waker in wait.wakers}


@pytest.mark.parametrize('given', ['', ", parameter_overrides=[Parameter('other', value=True)]"])
@pytest.mark.parametrize('loop', LOOPS)
def test_without_simulated_time_such_a_loop_ends_by_itself(
    tmp_path: Path, loop: list[str], given: str
) -> None:
    found = _scanned(tmp_path, given, loop, loop)

    assert [each for each in found.diagnostics if each.slug == 'nobody-spins'] == []
    names = [each.name for unit in found.units for each in unit.callbacks]
    assert 'clock_callback' not in names


@pytest.mark.parametrize(
    'loop',
    [
        [
            START,
            'tries = 0',
            'while self.clock.now() == start and tries < 5:',
            '    tries += 1',
            '    time.sleep(0.1)',
        ],
        [
            'begun = time.time()',
            'while self.clock.now().nanoseconds == 0 and time.time() < begun + 1.0:',
            '    time.sleep(0.1)',
        ],
        [START, 'while self.clock.now() == start:', '    rclpy.spin_once(self)'],
    ],
)
def test_a_counter_a_real_clock_or_a_spin_ends_it(tmp_path: Path, loop: list[str]) -> None:
    found = _scanned(tmp_path, SIMULATED, loop, ['pass'])

    assert [each for each in found.diagnostics if each.slug == 'nobody-spins'] == []


def test_a_thread_that_spins_moves_the_clock(tmp_path: Path) -> None:
    spin = 'threading.Thread(target=rclpy.spin, args=(self,), daemon=True).start()'

    found = _scanned(tmp_path, SIMULATED, [spin, *LOOPS[0]], ['pass'])

    assert [each for each in found.diagnostics if each.slug == 'nobody-spins'] == []
