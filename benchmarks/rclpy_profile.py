"""
Growth of profile rclpy with callbacks, threads, groups and callers.

``python benchmarks/rclpy_profile.py [--seconds 60]`` prints CPU time and states of the queries
that findings rest on, of units whose callbacks are timers, subscriptions, services and clients in
turn. One group of each unit is reentrant, the others are exclusive. A caller is a timer that calls
a client of another group; nobody in the unit answers.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from dataclasses import dataclass

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Profile, Text
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

KINDS = (EntityKind.TIMER, EntityKind.SUBSCRIPTION, EntityKind.SERVICE, EntityKind.CLIENT)


@dataclass(frozen=True)
class Size:
    """A unit to verify."""

    callbacks: int
    groups: int
    threads: int
    callers: int


SIZES = (
    Size(4, 2, 4, 0),
    Size(4, 2, 4, 1),
    Size(8, 4, 8, 0),
    Size(8, 4, 8, 2),
    Size(12, 4, 8, 0),
    Size(12, 4, 8, 1),
    Size(12, 4, 8, 2),
    Size(12, 4, 8, 3),
    Size(20, 5, 8, 0),
    Size(20, 5, 8, 2),
    Size(30, 6, 8, 0),
    Size(30, 6, 8, 2),
    Size(30, 6, 8, 3),
)
#: The whole unit grows too fast for more.
SIZES_OF_WHOLES = SIZES[:6]


def make_unit(size: Size) -> Spec:
    """Make the unit; callers come first, each with the client of its own group of four."""
    return Spec(
        name='grown',
        callbacks=tuple(_callback(number, size) for number in range(size.callbacks)),
        groups=tuple(
            CallbackGroup(
                name=f'g{number}', type=GroupType.EXCLUSIVE if number else GroupType.REENTRANT
            )
            for number in range(size.groups)
        ),
        executor=Executor(
            name='executor',
            kind='MultiThreadedExecutor',
            threads=tuple(f'thread_{number}' for number in range(size.threads)),
        ),
    )


def _callback(number: int, size: Size) -> Callback:
    kind = KINDS[number % len(KINDS)]
    calls = kind is EntityKind.TIMER and number // len(KINDS) < size.callers
    return Callback(
        name=f'c{number}',
        type=kind.published_type,
        entity=kind,
        group=f'g{(number // len(KINDS) + number) % size.groups}',
        node='grown',
        key=None if kind is EntityKind.TIMER else f'name_{number}',
        blocking=(Blocking(call='client.call', on=f'c{number + 3}'),) if calls else (),
    )


def measure(size: Size, options: Options) -> tuple[Verification, float]:
    """Verify one unit; give the CPU seconds too."""
    closed = close(make_unit(size))
    started = time.process_time()
    verification = verify_unit(closed, options)
    return verification, time.process_time() - started


def print_table(title: str, sizes: tuple[Size, ...], options: Options) -> None:
    """Print a row of Markdown for each size."""
    print(f'\n{title}\n')
    print('| callbacks, groups, threads, callers | queries | open | states | CPU s |')
    print('|---|---|---|---|---|')
    for size in sizes:
        verification, seconds = measure(size, options)
        verdicts = Counter(result.verdict for result in verification.results)
        print(
            f'| {size.callbacks}, {size.groups}, {size.threads}, {size.callers} '
            f'| {len(verification.results)} | {verdicts[Verdict.UNDECIDED]} '
            f'| {verification.states} | {seconds:.2f} |',
            flush=True,
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--seconds', type=float, default=60.0, help='limit of one verification')
    limits = Limits(seconds=parser.parse_args().seconds)
    sliced = Options(profile=Profile.RCLPY, structural=False, limits=limits)
    # A limit on states asks for the whole unit at once; the models are read once before.
    whole = Options(
        profile=Profile.RCLPY,
        structural=False,
        limits=Limits(seconds=limits.seconds, states=10**9),
    )
    plain = Options(profile=Profile.RCLPY, text=Text.PLAIN, structural=False, limits=limits)
    measure(SIZES[0], whole)
    print_table('As findings ask: slices of large units', SIZES, sliced)
    print_table('Whole units, compact text', SIZES_OF_WHOLES, whole)
    print_table('Whole units, plain text', SIZES_OF_WHOLES[:2], plain)


if __name__ == '__main__':
    main()
