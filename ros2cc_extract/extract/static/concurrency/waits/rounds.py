"""How often a run waits at one place: in each known round of the loops around it."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.machine.wake_operations import EntityRef
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.machine.world import RECENT
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import PAUSES, Blocking


def note_round(
    effects: EffectLog, block: Blocking, current: tuple[int, ...], *, is_open: bool
) -> None:
    """A wait that is met again in another round of a loop is waited once more."""
    number = len(effects.blocking)
    for known in range(number - 1, max(0, number - RECENT) - 1, -1):
        other = effects.blocking[known]
        if _is_same_wait(block, replace(other, times=block.times, or_more=block.or_more)):
            rounds = effects.rounds.setdefault(known, set())
            more = 0 if current in rounds else block.times
            rounds.add(current)
            effects.met.append((known, more))
            times = other.times + more
            or_more = other.or_more or (is_open and times > 1)
            effects.blocking[known] = replace(other, times=times, or_more=or_more)
            return
    effects.rounds[number] = {current}
    effects.met.append((number, block.times))
    effects.blocking.append(block)


def forget_rounds(effects: EffectLog, first: int, tests: Collection[Place]) -> None:
    """
    How often a loop sleeps that waits as a whole is how long that wait lasts.

    :param first: where the waits of its rounds begin.
    :param tests: where the loop stands, and what it asks.
    """
    inside = effects.blocking[first:]
    if any(block.source in tests and block.call not in PAUSES for block in inside):
        effects.blocking[first:] = [
            replace(block, or_more=block.or_more and block.times > 1) for block in inside
        ]


def _is_same_wait(one: Blocking, other: Blocking) -> bool:
    """References to two objects are equal as texts."""
    if one != other:
        return False
    for here, there in ((one.on, other.on), (one.resource, other.resource)):
        are_references = isinstance(here, EntityRef) and isinstance(there, EntityRef)
        if are_references and here.number != there.number:  # type: ignore[union-attr]
            return False
    return True
