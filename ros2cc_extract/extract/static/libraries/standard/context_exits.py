"""What the end of a ``with`` over pools and semaphores does."""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.accesses.held_locks import is_counter
from ros2cc_extract.extract.static.concurrency.notes import Notes
from ros2cc_extract.extract.static.libraries.standard.futures import is_pool, note_leaving
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.values.values import Instance, Value
from ros2cc_extract.source_locations import Place


class StandardBlocks(Notes):
    """A pool waits for all that was handed to it, and a semaphore is given back."""

    def note_left_block(self, value: Value, place: Place) -> None:
        """A ``with`` over ``value`` ends; a pool waits for all that was handed to it."""
        if is_pool(value):
            note_leaving(self, value, place)
        state = value.state if isinstance(value, Instance) else None
        is_stock = isinstance(state, PlainState) and state.kind == 'semaphore'
        if is_stock or (isinstance(value, Instance) and is_counter(self.world, value)):
            self.note_wake(value, Word.RELEASE, place)
            self.note_release(value)
