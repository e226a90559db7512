"""
What a callback does that is in no model, in words.

Verdicts that rest on the callback's end must not be believed then.
"""

from __future__ import annotations

from ros2cc_extract.generator.nested_spins import nested_spins
from ros2cc_extract.generator.waits import unknown_ends
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Callback, Spec


def left_out_of_models(callback: Callback, spec: Spec) -> tuple[str, ...]:
    """
    Say what may hold a callback forever, or let others run inside it, and is in no model.

    A service that nobody in the unit offers may be absent; so may code that sets an event, or
    makes a future done, that could not be followed. And a run that had not ended when it was
    recorded may wait for what is unknown here.
    """
    found: dict[object, str] = {}
    for block in unknown_ends(callback, spec):
        found.setdefault(block.source or block, f'{block.call}{_at(block, callback)}')
    return (*found.values(), *unexplained_runs(callback))


def unexplained_runs(callback: Callback) -> tuple[str, ...]:
    """Say that a run had not ended when it was recorded, where no wait is known that it was in."""
    measured = callback.measured
    if measured is None or not measured.running or callback.blocking:
        return ()
    return (f'what held {callback.display_name}, which had not ended when it was recorded',)


def is_entered_unseen(callback: Callback, spec: Spec) -> bool:
    """True where others may run inside it, in a nested spin that is in no model."""
    return any(spin is None for _, spin in nested_spins(callback, spec))


def _at(block: Blocking, callback: Callback) -> str:
    return f' at {block.source}' if block.source else f' in {callback.display_name}'
