"""Branches that the default of a parameter does not lead to, and what setting does."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.values.assumed_defaults import PARAMETER
from ros2cc_extract.extract.static.python.values.values import Mystery, Value, source_text
from ros2cc_extract.source_locations import Place


def note_arms(
    machine: Machine,
    test: ast.expr,
    asked: Value | None,
    place: Place,
    *,
    is_opposite: bool = False,
) -> None:
    """
    An ``if`` at ``place`` is open, because a parameter decides: its first arm is number 0.

    What an earlier round of a loop, or an earlier call, has found there holds no longer.
    """
    for arm in (0, 1):
        machine.world.conditions.pop((place, arm), None)
    if not isinstance(asked, Mystery) or asked.default is None:
        return
    holds = machine.truth(asked.default)
    if holds is None or not asked.unknown.reason.startswith(PARAMETER):
        return
    other_arm = int(holds) if not is_opposite else int(not holds)
    known = asked.unknown.reason.removeprefix('value of ')
    text = source_text(test)
    machine.world.conditions[place, other_arm] = (
        f'{text} does not hold, which it does by default: {known}'
        if holds
        else f'{text} holds, which it does not by default: {known}'
    )


def only_if(world: World) -> str | None:
    """What setting leads to what is done now, where the defaults do not."""
    begun = len(world.callback_path)
    return next((c for step in world.path[begun:] if (c := world.conditions.get(step))), None)
