"""Signs that a program is not followed to its end."""

from __future__ import annotations

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.python.machine.world import Cut, World
from ros2cc_extract.source_locations import Place


def note_cut(world: World, place: Place, message: str) -> None:
    """Say once that what stands at ``place`` is not followed, or not to its end."""
    if any((cut.reason, cut.place) == (message, place) for cut in world.cut):
        return
    world.diagnostics.append(
        Diagnostic(
            severity=Severity.WARNING,
            slug='not-followed',
            place=place,
            message=message,
            help='what it would create is missing from the units',
        )
    )
    world.cut.append(Cut(message, place))
