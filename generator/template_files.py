"""The template files of each text of each profile."""

from __future__ import annotations

from dataclasses import replace
from enum import Enum
from typing import TYPE_CHECKING

from ros2cc_extract.generator.executor_kinds import ExecutorKind
from ros2cc_extract.light_dataclasses import dataclass

if TYPE_CHECKING:
    from ros2cc_extract.generator.unit import Unit


class Profile(Enum):
    """The profile of the model: which executor it describes."""

    PAPER = 'paper'
    RCLPY = 'rclpy'


class Text(Enum):
    """
    Which text of a profile: the whole one, or one with few states and the same verdicts.

    The compact text answers the queries it is rendered with, no others: it lets only so many
    callbacks move as these queries need.
    """

    PLAIN = 'plain'
    COMPACT = 'compact'


@dataclass(frozen=True, kw_only=True)
class Sources:
    """The template files of one text, named from the folder ``profiles``."""

    declarations: str
    system: str
    automata: tuple[str, ...]


_GROUP = 'shared/callback_group.xml.j2'

PUBLISHED = Sources(
    declarations='paper/declarations.c.j2',
    system='shared/system.c.j2',
    automata=(
        'paper/plain/callback.xml.j2',
        _GROUP,
        'paper/plain/thread.xml.j2',
        'paper/plain/executor.xml.j2',
    ),
)

_COMPACT = Sources(
    declarations='paper/compact/declarations.c.j2',
    system='paper/compact/system.c.j2',
    automata=(_GROUP, 'paper/compact/thread.xml.j2', 'paper/compact/executor.xml.j2'),
)

# Without a bound a callback may change its readiness forever while nothing else moves.
_COMPACT_FOR_EVER = replace(
    _COMPACT, automata=('paper/compact/callback.xml.j2', *_COMPACT.automata)
)

_EXECUTOR_FILE = {
    ExecutorKind.SINGLE_THREADED: 'single_threaded',
    ExecutorKind.MULTI_THREADED: 'multi_threaded',
    ExecutorKind.EVENTS: 'events',
    ExecutorKind.ASYNCIO: 'asyncio',
}
# The thread of a loop begins and suspends callbacks as that of an executor does which spins.
_THREAD_FILE = {**_EXECUTOR_FILE, ExecutorKind.ASYNCIO: 'single_threaded'}


def choose_sources(profile: Profile, text: Text, unit: Unit) -> Sources:
    """The files for one text; those of profile rclpy depend on the executor."""
    if profile is Profile.PAPER:
        if text is Text.PLAIN:
            return PUBLISHED
        return _COMPACT_FOR_EVER if unit.max_cycle is None else _COMPACT
    executor = _EXECUTOR_FILE[unit.kind]
    beside = ('rclpy/activity.xml.j2',) if unit.activities else ()
    return Sources(
        declarations=f'rclpy/{executor}_declarations.c.j2',
        system='shared/system.c.j2',
        automata=(
            'rclpy/callback.xml.j2',
            _GROUP,
            *beside,
            f'rclpy/{_THREAD_FILE[unit.kind]}_thread.xml.j2',
            f'rclpy/{executor}_executor.xml.j2',
        ),
    )
