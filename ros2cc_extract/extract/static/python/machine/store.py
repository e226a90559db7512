"""
The writes of the abstract machine: undone after one branch, joined after all.

Only this module changes ``slots``. Lists and dictionaries in slots are replaced, never
changed in place, so that a write can be undone by putting the old value back.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    SERIALS,
    Bound,
    Class,
    Function,
    Heaped,
    Instance,
    Value,
    choice,
    options_of,
)

Slot = tuple[Heaped, Any]
Writes = dict[tuple[int, Any], tuple[Heaped, Any, Any, bool]]
"""By owner and slot: both, what the slot holds then, and whether its branch made the owner."""


_CONTENTS = ('entries', 'items', 'many')
"""Slots of collections, see ``containers.py``."""


class Store:
    """The log of writes since the start of the run."""

    def __init__(self) -> None:
        self._trail: list[tuple[Heaped, Any, Any]] = []
        self._depth = 0
        self._opened: list[int] = []
        self._marks: list[int] = []
        self._shown: list[Writes] = []
        self._before: dict[tuple[int, str], tuple[Heaped, str, Any]] | None = None

    @property
    def depth(self) -> int:
        """How many branches are open."""
        return self._depth

    def reset(self) -> None:
        """Forget every open branch after a run that was cut off; writes stay as they are."""
        self._trail.clear()
        self._opened.clear()
        self._marks.clear()
        self._shown.clear()
        self._depth = 0

    def write(self, owner: Heaped, slot: Any, value: Any) -> None:
        """Set a slot of ``owner``."""
        if self._depth:
            self._trail.append((owner, slot, owner.slots.get(slot, ABSENT)))
        if self._before is not None and slot in _CONTENTS:
            self._before.setdefault((id(owner), slot), (owner, slot, owner.slots.get(slot)))
        owner.slots[slot] = value

    def keep_contents(self) -> None:
        """Others have run: they have found in collections what is taken out from now on."""
        self._before = self._before or {}

    def give_contents_back(self) -> None:
        """Others are followed now: put back what was taken out since."""
        before, self._before = self._before, None
        for owner, slot, old in (before or {}).values():
            now = owner.slots.get(slot)
            if isinstance(old, dict) and isinstance(now, dict):
                self.write(owner, slot, {**old, **now})
            elif isinstance(old, tuple) and isinstance(now, tuple):
                self.write(owner, slot, (*now, *(each for each in old if each not in now)))

    def remove(self, owner: Heaped, slot: Any) -> None:
        """Remove a slot of ``owner`` if it is there."""
        if slot in owner.slots:
            if self._depth:
                self._trail.append((owner, slot, owner.slots[slot]))
            del owner.slots[slot]

    @contextmanager
    def outside_branches(self) -> Iterator[None]:
        """Keep what is written inside, on whichever branch it happens first."""
        branches = self._trail, self._opened, self._marks, self._depth
        self._trail, self._opened, self._marks, self._depth = [], [], [], 0
        try:
            yield
        finally:
            self._trail, self._opened, self._marks, self._depth = branches

    def open_branch(self) -> int:
        """Start a branch; returns the mark that ``close_branch`` wants."""
        self._depth += 1
        self._opened.append(next(SERIALS))
        self._marks.append(len(self._trail))
        return len(self._trail)

    def close_branch(self, mark: int) -> Writes:
        """Undo every write since ``mark`` and return what the branch had written."""
        written: Writes = {}
        opened = self._opened.pop()
        self._marks.pop()
        while len(self._trail) > mark:
            owner, slot, old = self._trail.pop()
            key = (id(owner), slot)
            if key not in written:
                is_new = owner.serial > opened
                written[key] = (owner, slot, owner.slots.get(slot, ABSENT), is_new)
            if old is ABSENT:
                owner.slots.pop(slot, None)
            else:
                owner.slots[slot] = old
        self._depth -= 1
        return written

    def show(self, thing: Value) -> None:
        """
        Others run now: in slots that the outermost branch has set to ``thing`` they find it.

        The branch may set them anew before its end, as a coroutine does that awaits one future
        after the other; ``take_shown`` gives these states beside that at its end.
        """
        if not self._depth:
            return
        shown: Writes = {}
        for owner, slot, _ in self._trail[self._marks[0] :]:
            now = owner.slots.get(slot, ABSENT)
            if isinstance(owner, (Instance, Class)) and _holds(now, thing):
                is_new = owner.serial > self._opened[0]
                shown[id(owner), slot] = owner, slot, now, is_new
        if shown:
            self._shown.append(shown)

    def take_shown(self) -> list[Writes]:
        """Give what ``show`` has kept, and forget it."""
        shown, self._shown = self._shown, []
        return shown

    def unwind(self, depth: int) -> None:
        """Undo the branches beyond ``depth``, which a run that was cut off has left open."""
        while self._depth > depth:
            self.close_branch(self._marks[-1])

    def join(self, branches: list[Writes], leaving: Sequence[Writes] = ()) -> None:
        """
        Write what may hold after one of ``branches``, which all began in this state.

        :param leaving: branches that leave the function; only what they wrote counts.
        """
        slots = {
            key: (entry[0], entry[1])
            for writes in (*branches, *leaving)
            for key, entry in writes.items()
        }
        made_here = {key for writes in (*branches, *leaving) for key in writes if writes[key][3]}
        for key, (owner, slot) in slots.items():
            now = owner.slots.get(slot, ABSENT)
            ends = [
                writes[key][2] if key in writes else now
                for writes in branches
                if key in writes or key not in made_here
            ]
            ends.extend(writes[key][2] for writes in leaving if key in writes)
            if ABSENT in ends and isinstance(owner, (Instance, Class)):
                ends = _with_inherited(owner, slot, ends)
            joined = join_contents(ends)
            if joined is ABSENT:
                self.remove(owner, slot)
            else:
                self.write(owner, slot, joined)


def _holds(content: Any, thing: Value) -> bool:
    if isinstance(content, dict):
        content = (*content.values(),)
    items = content if isinstance(content, tuple) else (content,)
    return any(
        option is thing for item in items if isinstance(item, Value) for option in options_of(item)
    )


def _with_inherited(owner: Instance | Class, slot: Any, ends: list[Any]) -> list[Any]:
    """What the class gives on the branches that set no attribute of the object's own."""
    if all(end is ABSENT for end in ends):
        return ends
    given = next(
        (c.slots[slot] for c in owner.mro if isinstance(c, Class) and slot in c.slots), ABSENT
    )
    if isinstance(given, Function):
        is_method = isinstance(owner, Instance) and given.binding == 'method'
        given = Bound(owner, given) if is_method else ABSENT
    return [given if end is ABSENT and isinstance(given, Value) else end for end in ends]


def join_contents(ends: list[Any]) -> Any:
    """Join what one slot holds at the end of several branches."""
    first = ends[0]
    if all(end is first for end in ends[1:]):
        return first
    kinds = {type(end) for end in ends}
    if kinds <= {tuple, type(ABSENT)}:
        return _join_items([() if end is ABSENT else end for end in ends])
    if kinds <= {dict, type(ABSENT)}:
        return _join_entries([{} if end is ABSENT else end for end in ends])
    if all(isinstance(end, Value) for end in ends):
        return choice(ends)
    return next(end for end in reversed(ends) if end is not None and end is not ABSENT)


def _join_items(ends: list[tuple[Value, ...]]) -> tuple[Value, ...]:
    length = max(len(end) for end in ends)
    columns = ([end[i] if i < len(end) else ABSENT for end in ends] for i in range(length))
    return tuple(choice(column) for column in columns)


def _join_entries(ends: list[dict[Value, Value]]) -> dict[Value, Value]:
    keys = dict.fromkeys(key for end in ends for key in end)
    return {key: choice([end.get(key, ABSENT) for end in ends]) for key in keys}
