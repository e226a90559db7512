"""The steps that the running node took, as they were reported, in words."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from ros2cc_extract.confirm.observations import Row
from ros2cc_extract.confirm.schedules import Schedule

MOST_STEPS = 16
"""The last ones; what a node does before is as it always does."""
_RACE = 'line {line} writes {own} over {other}, which another thread has set since it read {read}'


def recorded_run(schedule: Schedule, rows: Sequence[Row]) -> tuple[str, ...]:
    """
    Say what happened, one step a line: seconds since the first one, thread, and what it did.

    What rclpy does by itself is left out. What repeats itself, as a timer that has no part in it,
    stands for its first and its last time.
    """
    own = (row for row in rows if row.get('of_program', True))
    steps = [(row, words) for row in own if (words := _words(schedule, row)) is not None]
    if not steps:
        return ()
    threads = _numbers(row['thread'] for row, _ in steps if 'thread' in row)
    begun = float(steps[0][0]['at'])
    lines = list(_without_repetitions(steps, threads))[-MOST_STEPS:]
    return tuple(f'{at - begun:7.3f} s  {line}' for at, line in lines)


def _without_repetitions(
    steps: Sequence[tuple[Row, str]], threads: Mapping[int, int]
) -> Iterator[tuple[float, str]]:
    lines = [
        (float(row['at']), f'thread {threads[row["thread"]]}: {words}')
        if 'thread' in row
        else (float(row['at']), words)
        for row, words in steps
    ]
    last = {line: index for index, (_, line) in enumerate(lines)}
    first: set[str] = set()
    for index, (at, line) in enumerate(lines):
        # The first time, and the last: what led there, and what it ended with.
        if line not in first or last[line] == index:
            yield at, line
        first.add(line)


def _words(schedule: Schedule, row: Row) -> str | None:
    report = _WORDS.get(str(row['what']))
    try:
        return report(schedule, row) if report else None
    except (KeyError, IndexError, TypeError):
        return None  # another process has written there


def _numbers(threads: Iterator[Any]) -> dict[int, int]:
    return {thread: number for number, thread in enumerate(dict.fromkeys(threads), start=1)}


def _line(schedule: Schedule, row: Row) -> int:
    return schedule.points[row['point']].first


_WORDS: Mapping[str, Callable[[Schedule, Row], str]] = {
    'begin': lambda _, row: f'{row["name"]} begins',
    'end': lambda _, row: f'{row["name"]} ends',
    'reached': lambda schedule, row: f'stands at line {_line(schedule, row)}',
    'passed': lambda schedule, row: f'is past line {_line(schedule, row)}',
    'nested': lambda schedule, row: f'{row["name"]} is taken inside line {_line(schedule, row)}',
    'raised': lambda schedule, row: (
        f'line {_line(schedule, row)} raises {row["type"]}: {row["text"]}'
    ),
    'destroyed': lambda _, row: f'has destroyed a {row["name"]}',
    'raced': lambda _, row: _RACE.format(**row),
    'open': lambda _, row: 'nothing is held back any more',
}
