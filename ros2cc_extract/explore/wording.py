"""What an exploration has found, as text and as JSON."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from ros2cc_extract.explore.exploring import Exploration
from ros2cc_extract.explore.failures import Kind, as_row
from ros2cc_extract.explore.replaying import Replay
from ros2cc_extract.explore.scenario import PLAIN, Found
from ros2cc_extract.text_escaping import lines as escaped

# What an order begins with, and what it ends with, is shown of a long one.
_AT_EACH_END = 8


def found_as_text(found: Found, file: Path | None) -> str:
    """Say what went wrong, what led there, and how to repeat it."""
    return escaped('\n'.join(_of_found(found, file)) + '\n')


def _of_found(found: Found, file: Path | None) -> Iterator[str]:
    failure = found.failure
    yield f'{shown_path(failure.file)}:{failure.line}: {failure.kind.value}: {failure.words}'
    yield from (f'  {line}' for line in failure.evidence.splitlines())
    if found.schedule['policy'] == PLAIN:
        yield '  seen when the program ran as it came, without any schedule'
    else:
        yield f'  schedule {found.number}, in this order:'
        order = [f'    {key}: {at}' for key, at in found.tail]
        left = len(order) - 2 * _AT_EACH_END
        if left > 1:
            order[_AT_EACH_END:-_AT_EACH_END] = [f'    … {left} steps']
        yield from order
    if found.times > 1:
        yield f'  seen in {found.times} schedules'
    if file is not None:
        yield f'  repeat: ros2cc-extract explore --replay {file}'


def summary(so_far: Exploration, seconds: float) -> str:
    """Count in one line what was run and what was found."""
    count = len(so_far.found)
    what = f'{count} failure{"" if count == 1 else "s"}' if count else 'no failure'
    times = 'process' if so_far.processes == 1 else 'processes'
    return (
        f'{what} in {so_far.done} schedules and a plain run, {so_far.begins} callbacks begun, '
        f'{so_far.processes} {times}, {seconds:.0f} s: {so_far.why_ended or "interrupted"}'
    )


def as_json(
    so_far: Exploration,
    files: Mapping[int, Path],
    *,
    seconds: float,
    release: str | None,
    limits: Sequence[str],
) -> str:
    """Give one object; ``files`` by the place of a failure in the list."""
    rows = [
        {
            **as_row(each.failure),
            'schedule': each.number,
            'policy': each.schedule['policy'],
            'seed': each.schedule.get('seed'),
            'times': each.times,
            'order': [list(choice) for choice in each.tail],
            'file': str(files[number]) if number in files else None,
        }
        for number, each in enumerate(so_far.found)
    ]
    return (
        json.dumps(
            {
                'rclpy': release,
                'schedules': so_far.done,
                'processes': so_far.processes,
                'callbacks_begun': so_far.begins,
                'seconds': round(seconds, 1),
                'ended': so_far.why_ended or 'interrupted',
                'statement': so_far.statement or None,
                'limits': list(limits),
                'failures': rows,
            },
            indent=2,
        )
        + '\n'
    )


def replay_as_text(found: Found, result: Replay) -> str:
    """Say whether a failure was seen again."""
    place = f'{shown_path(found.failure.file)}:{found.failure.line}'
    in_time = f'in {result.seconds:.0f} s'
    if result.failure is None:
        text = (
            f'{place}: {found.failure.kind.value} was not seen again {in_time}, in '
            f'{result.tries} tries of {result.processes} processes\n'
        )
    else:
        evidence = ''.join(f'  {line}\n' for line in result.failure.evidence.splitlines())
        tries = 'try' if result.tries == 1 else 'tries'
        text = (
            f'{place}: {result.failure.kind.value} repeated {in_time}, {result.tries} {tries}: '
            f'{result.failure.words}\n{evidence}'
        )
    return escaped(text)


def replay_as_json(found: Found, result: Replay) -> str:
    """Give one object."""
    seen = None if result.failure is None else as_row(result.failure)
    row = {
        'asked': as_row(found.failure),
        'seen': seen,
        'tries': result.tries,
        'processes': result.processes,
        'seconds': round(result.seconds, 1),
    }
    return json.dumps(row, indent=2) + '\n'


def file_name(found: Found, number: int) -> str:
    """Name the file of a failure: ``1-hang-arm-24.json``."""
    kind = found.failure.kind.value.replace(' ', '-')
    stem = ''.join(c if c.isalnum() else '-' for c in Path(found.failure.file).stem)
    return f'{number}-{kind}-{stem}-{found.failure.line}.json'


def shown_path(file: str) -> str:
    """From the current folder where the file is below it, else as it is."""
    try:
        relative = os.path.relpath(file)
    except (ValueError, OSError):
        return file
    return file if relative.startswith('..') else relative


def limits_of(so_far: Exploration, points: int, sources: int) -> list[str]:
    """What this exploration did not look at, in sentences."""
    reported = []
    if not sources:
        reported.append('no source was scanned: callbacks are ordered, but none is held inside')
    elif not points:
        reported.append('no wait, lock or shared attribute was found: callbacks are only ordered')
    if not so_far.begins:
        reported.append('no callback of the program began, or none that its group is asked for')
    if any(each.failure.kind is Kind.STANDS for each in so_far.found):
        reported.append('of what stands it is not decided whether it ends')
    return reported
