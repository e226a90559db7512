"""
The three cases of the paper on the real executors.

The publisher runs at four times the pace of the node, so that msg_C alone is more than one
callback at a time can work off. Each test waits until the node does what the case is about, which
another case never does; a publisher that is late delays that and nothing else.
"""

from __future__ import annotations

import io
import signal
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest
from child import Child
from conftest import EXAMPLES

from ros2cc_extract.extract.live.recordings.collect import specs_of
from ros2cc_extract.extract.live.run import read_directory
from ros2cc_extract.spec.model import CallbackType
from ros2cc_extract.verify.results.load import LoadKind, load_of

Start = Callable[..., Child]
NODE_PACE = ('--ros-args', '-p', 'time_scale:=0.04')
PUBLISHER_PACE = ('--ros-args', '-p', 'time_scale:=0.01')
TIMERS = {'timer A', 'timer B'}
IN_TURNS = ['msg_C begins', 'msg_D begins'] * 5
ONLY_C = ['msg_C begins'] * 12


def run_case(start_example: Start, number: int, until: Callable[[list[str]], bool]) -> list[str]:
    """Run a case with its publisher until the said words fulfil a condition; give the words."""
    start_example('paper_publisher', *PUBLISHER_PACE)
    case = start_example(f'paper_case{number}', *NODE_PACE)
    case.read_until(lambda lines: until(words_of(lines)))
    case.end(signal.SIGINT)
    return words_of(case.lines)


def words_of(lines: Sequence[str]) -> list[str]:
    return [line.strip().rpartition(']: ')[2] for line in lines]


def last_begun(words: Sequence[str], count: int) -> list[str]:
    """Say which subscriptions were served last."""
    return [word for word in words if word.endswith('begins')][-count:]


def overlapping(words: Sequence[str]) -> bool:
    """Whether one callback began before another had ended."""
    depth = deepest = 0
    for word in words:
        depth += word.endswith('begins') - word.endswith('ends')
        deepest = max(deepest, depth)
    return deepest > 1


def test_case_1_serves_both_subscriptions_in_turns(start_example: Start) -> None:
    words = run_case(
        start_example,
        1,
        lambda said: last_begun(said, len(IN_TURNS)) == IN_TURNS and set(said) >= TIMERS,
    )
    assert not overlapping(words)


def test_case_2_starves_the_second_subscription(start_example: Start) -> None:
    words = run_case(start_example, 2, lambda said: last_begun(said, len(ONLY_C)) == ONLY_C)
    assert not overlapping(words)


def test_case_3_works_on_both_at_the_same_time(start_example: Start) -> None:
    run_case(start_example, 3, lambda said: overlapping(said) and set(said) >= TIMERS)


@pytest.mark.parametrize('number', [1, 2, 3])
def test_case_brings_its_own_publisher(number: int, start_example: Start) -> None:
    case = start_example(f'paper_case{number}', '--with-publisher', *NODE_PACE)
    case.read_until(lambda lines: any('msg_C ends' in line for line in lines))
    case.end_well(signal.SIGTERM)


Kinds = Mapping[str, LoadKind]


def await_measured(
    start: Start,
    start_example: Start,
    folder: Path,
    scale: float,
    publisher_scale: float,
    expected: Kinds,
) -> None:
    """Run case 2 with the hook until its measured rates say so of its subscriptions."""
    pace = ('--ros-args', '-p', 'time_scale:=')
    start_example('paper_publisher', *pace[:-1], f'{pace[-1]}{publisher_scale}')
    node = EXAMPLES / 'paper_case2' / 'node.py'
    case = start(node, *pace[:-1], f'{pace[-1]}{scale}', recorded_into=folder)
    case.read_until(lambda lines: sum('msg_C ends' in line for line in lines) >= 15)
    case.wait_for(lambda: kinds_in(folder) == expected)


def kinds_in(folder: Path) -> Kinds:
    """What the rates measured so far say of the subscriptions, by callback."""
    (recording,) = read_directory(folder, io.StringIO())
    (spec,) = specs_of(recording)
    return {
        str(callback.function_name): load_of(spec, callback).kind
        for callback in spec.callbacks
        if callback.type is CallbackType.SUB and not callback.builtin
    }


def test_case_2_is_told_starved_by_what_was_measured(
    start: Start, start_example: Start, tmp_path: Path
) -> None:
    expected = {'on_msg_c': LoadKind.FINE, 'on_msg_d': LoadKind.STARVED}
    await_measured(start, start_example, tmp_path, 0.05, 0.01, expected)


def test_case_2_is_told_fine_when_msg_c_comes_seldom(
    start: Start, start_example: Start, tmp_path: Path
) -> None:
    """Every 2.5 units."""
    expected = {'on_msg_c': LoadKind.FINE, 'on_msg_d': LoadKind.FINE}
    await_measured(start, start_example, tmp_path, 0.1, 0.25, expected)
