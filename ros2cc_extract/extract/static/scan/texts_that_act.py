"""Whether a text may make entities or wait, by the names of all that it leads to."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.program.relevance import (
    creates_entities,
    may_wait,
    waits_for_others,
)
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.objects.reachable_texts import reachable


def may_make_entities(world: World, start: ast.AST) -> bool:
    """Whether something that ``start`` names makes or serves entities."""
    return any(creates_entities(node) for node in reachable(world, start))


def leads_to_waits(world: World, start: ast.AST) -> bool:
    """Whether something that ``start`` names waits for other code, or may."""
    return any(waits_for_others(node) or may_wait(node) for node in reachable(world, start))
