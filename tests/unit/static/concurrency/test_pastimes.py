"""What loops do while they wait, and which clocks they ask, is listed once."""

from __future__ import annotations

import ast

import pytest

from ros2cc_extract.extract.static.concurrency.waits.loops.loop_tests import tells_time
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import is_idle, only_waits


def loop(does: str) -> ast.While:
    (statement,) = ast.parse(f'while self.asked:\n    {does}').body
    assert isinstance(statement, ast.While)
    return statement


@pytest.mark.parametrize(
    'does', ["print('no')", "self.get_logger().error('no')", 'log.warning_once(1)', 'sleep(1)']
)
def test_a_loop_that_only_logs_is_idle(does: str) -> None:
    assert is_idle(loop(does))


@pytest.mark.parametrize('does', ['time.perf_counter()', 'time.time_ns()', 'clock.now()'])
def test_every_clock_is_known_wherever_loops_are_read(does: str) -> None:
    assert only_waits(loop(does))
    assert tells_time(loop(does))
    assert not is_idle(loop(does))
