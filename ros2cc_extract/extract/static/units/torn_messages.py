"""Objects that one callback publishes as a whole while another one changes them piece by piece."""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, Piece
from ros2cc_extract.extract.static.python.values.exclusive_paths import exclusive
from ros2cc_extract.spec.effects import Access


def pieces_of(doer: EntityState | ActivityState, world: RosWorld) -> tuple[Access, ...]:
    """What ``doer`` publishes and others change piece by piece, or the other way round."""
    mine = (doer.effects or EffectLog()).pieces
    if not mine:
        return ()
    doers: tuple[EntityState | ActivityState, ...] = (*world.entities, *world.activities)
    others = [
        each.effects.pieces for each in doers if each is not doer and each.effects is not None
    ]
    sent = {piece.access.name for pieces in others for piece in pieces if not piece.part}
    changed = {name for pieces in others for name in _torn(pieces)}
    reported = _torn(mine) & sent
    return tuple(
        dict.fromkeys(
            piece.access
            for piece in mine
            if piece.access.name in (reported if piece.part else changed)
        )
    )


def _torn(pieces: list[Piece]) -> set[str]:
    """Names of objects that are changed in more than one piece by one run."""
    changes = [piece for piece in pieces if piece.part]
    return {
        one.access.name
        for number, one in enumerate(changes)
        if one.again or any(_are_two(one, other) for other in changes[:number])
    }


def _are_two(one: Piece, other: Piece) -> bool:
    is_one = one.access.name != other.access.name or one.part == other.part
    return not is_one and not exclusive(one.path, other.path)
