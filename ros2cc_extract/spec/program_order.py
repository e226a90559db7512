"""In which order the text of a callback does things."""

from __future__ import annotations

from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Access, Act, Blocking


def steps(effect: Access | Act | Blocking) -> tuple[Place, ...]:
    """The way to a effect; ways of one callback are ordered as its text is, loops apart."""
    if isinstance(effect, Access) and effect.turn:
        return effect.turn
    return effect.chain if effect.source is None else (*effect.chain, effect.source)
