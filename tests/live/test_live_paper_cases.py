"""
The three cases of the paper on the real executors.

The publisher runs at twice the pace of the node, so that msg_C alone is more than one callback at
a time can work off: the verdicts are told apart by counts, never by clock times.
"""

from __future__ import annotations

import signal
from collections.abc import Callable

import pytest
from child import Child

Start = Callable[..., Child]
NODE_PACE = ('--ros-args', '-p', 'time_scale:=0.04')
PUBLISHER_PACE = ('--ros-args', '-p', 'time_scale:=0.02')


def run_case(start_example: Start, number: int, until: Callable[[list[str]], bool]) -> list[str]:
    """Run a case with its publisher until the said words fulfil a condition; give the words."""
    start_example('paper_publisher', *PUBLISHER_PACE)
    case = start_example(f'paper_case{number}', *NODE_PACE)
    words = [
        line.strip().rpartition(']: ')[2]
        for line in case.read_until(
            lambda lines: until([line.strip().rpartition(']: ')[2] for line in lines])
        )
    ]
    case.end(signal.SIGINT)
    return words


def overlapping(words: list[str]) -> bool:
    """Whether one callback began before another had ended."""
    depth = deepest = 0
    for word in words:
        depth += word.endswith('begins') - word.endswith('ends')
        deepest = max(deepest, depth)
    return deepest > 1


def test_case_1_serves_both_subscriptions_in_turns(start_example: Start) -> None:
    words = run_case(start_example, 1, lambda said: said.count('msg_D ends') >= 10)
    assert abs(words.count('msg_C begins') - words.count('msg_D begins')) <= 2
    assert {'timer A', 'timer B'} <= set(words)
    assert not overlapping(words)


def test_case_2_starves_the_second_subscription(start_example: Start) -> None:
    words = run_case(start_example, 2, lambda said: said.count('msg_C ends') >= 12)
    # It may run before the first msg_C is there, and when the publisher is late.
    assert words.count('msg_D begins') <= 2
    assert not overlapping(words)


def test_case_3_works_on_both_at_the_same_time(start_example: Start) -> None:
    words = run_case(
        start_example,
        3,
        lambda said: min(said.count('msg_C ends'), said.count('msg_D ends')) >= 10,
    )
    assert overlapping(words)
    assert {'timer A', 'timer B'} <= set(words)


@pytest.mark.parametrize('number', [1, 2, 3])
def test_case_brings_its_own_publisher(number: int, start_example: Start) -> None:
    case = start_example(f'paper_case{number}', '--with-publisher', *NODE_PACE)
    case.read_until(lambda lines: any('msg_C ends' in line for line in lines))
    assert case.end(signal.SIGTERM) == 0, case.text
