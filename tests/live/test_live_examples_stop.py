"""The examples end by themselves, without a word, however it is asked to."""

from __future__ import annotations

import signal
from collections.abc import Callable

import pytest
from child import Child

Start = Callable[..., Child]
# What rclpy or the interpreter say when something went wrong at the end.
COMPLAINTS = ('Traceback', 'Exception', 'InvalidHandle')

# An example for each way of being run, with what it says while it runs: rclpy.spin, one thread,
# several threads, blocked workers. That all end by SIGINT is seen in test_live_examples_hold.py.
ONE_OF_EACH_KIND = {
    'paper_case1': 'timer A',
    'service_and_client': 'gripper is',
    'two_groups': 'planned',
    'service_deadlock': 'asks for the map',
}


def is_clean(child: Child) -> bool:
    return not any(complaint in child.text for complaint in COMPLAINTS)


def test_example_ends_after_its_run_time(start_example: Start) -> None:
    # On a machine so busy that the time is over before the nodes are there, it gets more of it.
    for seconds in ('0.6', '6', '60'):
        child = start_example('two_nodes_one_executor', '--seconds', seconds)
        status = child.end()
        if '[odometry]' in child.text:
            break
    assert status == 0, child.text
    assert is_clean(child), child.text


@pytest.mark.parametrize(('name', 'said'), ONE_OF_EACH_KIND.items())
def test_example_ends_by_signal(name: str, said: str, start_example: Start) -> None:
    child = start_example(name)
    child.read_until(lambda lines: said in lines[-1] if lines else False)
    child.end_well(signal.SIGTERM)
    assert is_clean(child) or child.is_interrupted_in_rclpy, child.text
