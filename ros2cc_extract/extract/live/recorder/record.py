"""
What was seen of executors, nodes, groups and entities of this process.

Only records; all judgement comes later, in ``collect.py``. Runs inside the user's process: the
standard library only, nothing else of ours but its neighbours.

What may be called from any thread and at any time, also from a signal handler or the garbage
collector: ``events.append``, ``note_…`` (under a re-entrant lock).
"""

from __future__ import annotations

import itertools
import threading
from collections import deque
from collections.abc import Iterator
from typing import Any

from .deduplication import fold_entities, fold_executors, fold_nodes
from .entries import (
    WAITABLE_KINDS,
    EntityRecord,
    ExecutorRecord,
    GroupRecord,
    NodeRecord,
    TaskRecord,
    fill_entity,
    fill_node,
    has_waited,
    note_publishers,
    thread_count,
)
from .events import BEGIN, END, SIZE, Fields, unpack
from .frames import Creation, RawPlace, is_node, name_function
from .journal import new_journal
from .service_functions import called_functions
from .timings import Timings

# Half a minute of 4 kHz, should the writer not get the processor for that long.
EVENTS_KEPT = 120_000
LARGEST_BATCH = 1000

ENTITY_LISTS = ('timers', 'subscriptions', 'guards', 'clients', 'services', 'waitables')


class Recorder:
    """All that was seen in this process."""

    def __init__(self, *, traced: bool = False) -> None:
        self.traced = traced
        self.journal = new_journal(EVENTS_KEPT)
        self.entities: dict[int, EntityRecord] = {}
        self.losses: deque[str] = deque(maxlen=5)
        # Never used again, also not by a forked child: an event may still be on its way there.
        self._numbers = itertools.count(1)
        self.forget()

    def forget(self) -> None:
        """Begin anew, as a forked child must: what the parent made is not the child's."""
        self.lock = threading.RLock()
        # Counted up when something is new, and when something was measured.
        self.changes = 0
        self.measured = 0
        # Callbacks that have ended.
        self.ended = 0
        self.loss_count = 0
        # Set only if no executor was made before ours was the way to make one.
        self.sees_every_executor = False
        self.only_executor: ExecutorRecord | None = None
        self.executors: dict[int, ExecutorRecord] = {}
        self.nodes: dict[int, NodeRecord] = {}
        self.groups: dict[int, GroupRecord] = {}
        self.tasks: dict[tuple[Any, ...], TaskRecord] = {}
        self.all_executors: list[ExecutorRecord] = []
        self.all_nodes: list[NodeRecord] = []
        self.all_groups: list[GroupRecord] = []
        self.all_entities: list[EntityRecord] = []
        self._timings: dict[int, Timings] = {}
        # The hot path holds these two, so they are emptied and not replaced.
        self.entities.clear()
        self.journal.clear()
        self.losses.clear()

    def lose(self, error: BaseException) -> None:
        """Count a failure of our own that was swallowed."""
        self.loss_count += 1
        # What was lost may have been another executor.
        self.sees_every_executor, self.only_executor = False, None
        self.losses.append(repr(error))

    def note_executor(self, executor: Any, created: RawPlace | None = None) -> ExecutorRecord:
        with self.lock:
            record = self.executors.get(id(executor))
            if record is None or record.ref() is not executor:
                record = ExecutorRecord(next(self._numbers), executor, created)
                self.executors[id(executor)] = record
                self.all_executors.append(record)
                is_only = self.sees_every_executor and len(self.all_executors) == 1
                self.only_executor = record if is_only else None
                self.changes += 1
            return record

    def note_added(self, executor: Any, node: Any) -> None:
        with self.lock:
            node = self._node_behind(node)
            home, record = self.note_executor(executor), self.note_node(node)
            if home.threads is None:
                # Its constructor has ended; it may be gone before the next look.
                home.threads = thread_count(executor)
            if record.enter(home.number):
                for group in self._groups_of(node):
                    self.note_group(group)
                self.changes += 1
            else:
                # ``rclpy.spin_once`` adds and removes its node every time.
                self.measured += 1

    def note_removed(self, executor: Any, node: Any) -> None:
        with self.lock:
            home = self.note_executor(executor)
            record = self.note_node(self._node_behind(node))
            if record.leave(home.number, waited=has_waited(executor)):
                self.changes += 1
            else:
                self.measured += 1

    def note_node(self, node: Any) -> NodeRecord:
        with self.lock:
            record = self.nodes.get(id(node))
            if record is None or record.ref() is not node:
                record = NodeRecord(next(self._numbers), node)
                self.nodes[id(node)] = record
                self.all_nodes.append(record)
                self.changes += 1
            fill_node(record, node)
            return record

    def note_group(self, group: Any, creation: Creation | None = None) -> GroupRecord:
        with self.lock:
            record = self.groups.get(id(group))
            if record is None or record.ref() is not group:
                record = GroupRecord(next(self._numbers), group, creation)
                self.groups[id(group)] = record
                self.all_groups.append(record)
                self.changes += 1
            return record

    def note_entity(
        self, group: Any, entity: Any, creation: Creation | None = None
    ) -> EntityRecord:
        """Record an entity of ``group``; called again, fill in what was not known before."""
        with self.lock:
            record = self.entities.get(id(entity))
            if record is None or record.ref() is not entity:
                record = EntityRecord(next(self._numbers), entity, self.note_group(group).number)
                self.entities[id(entity)] = record
                self.all_entities.append(record)
                self._timings[record.number] = record.timings
            set_up = record.kind not in WAITABLE_KINDS or record.creation is not None
            if creation is not None:
                node, creation.node = creation.node, None
                record.creation = creation
                if node is not None:
                    self._join(record, group, node)
            # A waitable joins its group before its own class has set it up, then once more.
            if set_up and not record.complete:
                fill_entity(record, entity)
            self.changes += 1
            return record

    def note_task(self, executor: Any, kind: str, callback: Any) -> TaskRecord | None:
        """Record work outside every group; ``None`` for work of rclpy's own."""
        function = name_function(callback)
        if function is None or function.module.partition('.')[0] == 'rclpy':
            return None
        with self.lock:
            home = self.note_executor(executor).number
            key = kind, function.name, function.defined, home
            record = self.tasks.get(key)
            if record is None:
                record = TaskRecord(next(self._numbers), kind, function, home)
                self.tasks[key] = record
                owner = getattr(callback, '__self__', None)
                record.node = self.note_node(owner).number if is_node(owner) else None
            record.count += 1
            self.changes += 1
            return record

    def look_around(self) -> None:
        """Read the live lists of all nodes, and note what is new in them and what has gone."""
        with self.lock:
            for record in list(self.all_nodes):
                node = record.ref()
                if node is not None:
                    fill_node(record, node)
                    self._look_at(record, node)

    def settle(self) -> None:
        """Complete what was only begun; fold away entities that are gone and were made again."""
        with self.lock:
            for executor in self.all_executors:
                self._look_at_executor(executor)
            for entity in self.all_entities:
                self._settle_entity(entity)
            self._fold()

    def _settle_entity(self, record: EntityRecord) -> None:
        entity = record.ref()
        if entity is None:
            record.gone = True
        elif not record.complete:
            fill_entity(record, entity)

    def _fold(self) -> None:
        """Let memory depend on what the program's text makes, not on how often it makes it."""
        before = self.all_entities
        self.all_entities = fold_entities(before)
        # The events of a trace name executors and nodes by their numbers.
        if not self.traced:
            self.all_executors = fold_executors(self.all_executors, self.all_nodes, self.tasks)
            self.all_nodes, self.all_entities = fold_nodes(
                self.all_nodes, self.all_groups, self.all_entities, self.tasks
            )
        used = {entity.group for entity in self.all_entities}
        self.all_groups = [g for g in self.all_groups if g.number in used or g.ref() is not None]
        kept = {entity.number for entity in self.all_entities}
        for entity in before:
            if entity.number not in kept:
                self._timings.pop(entity.number, None)
        for known in (self.entities, self.groups, self.nodes, self.executors):
            for key in [key for key, record in known.items() if record.ref() is None]:
                del known[key]

    def take_events(self) -> bytes:
        """
        Take what has happened since the last time, and bring the timings up to date.

        At most ``LARGEST_BATCH`` events: what is held at once bounds the memory of a program
        that has fallen behind.
        """
        taken = self.journal.take(LARGEST_BATCH)
        find = self._timings.get
        for clock, thread, what, number in unpack(taken):
            if what <= END:
                timings = find(number)
                if timings is None:
                    continue
                if what == BEGIN:
                    timings.begin(clock, thread)
                elif what == END:
                    timings.end(clock, thread)
                    self.ended += 1
                else:
                    timings.refused += 1
        self.measured += len(taken) // SIZE
        return taken

    def running(self) -> list[tuple[int, int]]:
        """Give the entities whose callbacks run, each with when the first run of them began."""
        with self.lock:
            begun = [(number, each.begun) for number, each in self._timings.items()]
        return [(number, runs[0][0]) for number, runs in begun if runs]

    def open_runs(self, before: bytes) -> list[Fields]:
        """Give the begins of the runs that have not ended, but for those in ``before``."""
        with self.lock:
            begun = [(number, each.begun) for number, each in self._timings.items()]
        reported = {fields for fields in unpack(before) if fields[2] == BEGIN}
        rows = ((at, thread, BEGIN, number) for number, runs in begun for at, thread in runs)
        return [row for row in sorted(rows) if row not in reported]

    def _join(self, record: EntityRecord, group: Any, node: Any) -> None:
        owner = self.note_node(node)
        record.node = owner.number
        record.late = record.late or any(stay.waited for stay in owner.stays)
        self._claim(group, node, owner)

    def _claim(self, group: Any, node: Any, owner: NodeRecord) -> None:
        """Mark a group that belongs to a node: its default group, the private one of rates."""
        record = self.note_group(group)
        if getattr(node, 'default_callback_group', None) is group:
            # A program may put another group there; the one rclpy has made stays the default.
            owner.default_group = owner.default_group or record.number
            record.default, record.node = record.number == owner.default_group, owner.number
        elif getattr(node, '_rate_group', None) is group:
            record.rate, record.node = True, owner.number

    def _node_behind(self, node: Any) -> Any:
        """Give the node that an object hands on to what it lacks itself, as some programs do."""
        if is_node(node):
            return node
        known = (record.ref() for record in self.all_nodes)
        return next((each for each in known if each and each.handle is node.handle), node)

    def _groups_of(self, node: Any) -> Iterator[Any]:
        default = getattr(node, 'default_callback_group', None)
        if default is not None:
            yield default

    def _look_at(self, owner: NodeRecord, node: Any) -> None:
        present = set()
        for name in ENTITY_LISTS:
            for entity in list(getattr(node, name)):
                known = self.entities.get(id(entity))
                if known is None or known.ref() is not entity:
                    known = self.note_entity(entity.callback_group, entity)
                if known.node is None:
                    self._join(known, entity.callback_group, node)
                if not known.complete:
                    fill_entity(known, entity)
                present.add(known.number)
        self._note_called(owner, node)
        if note_publishers(owner, node):
            self.changes += 1
        self._note_destroyed(owner, present)

    def _note_called(self, owner: NodeRecord, node: Any) -> None:
        """What a node has let go of was called all the same."""
        for each in called_functions(node):
            row = each.kind, each.function, self.note_group(each.group).number
            if row not in owner.called:
                owner.called.append(row)
                self.changes += 1

    def _note_destroyed(self, owner: NodeRecord, present: set[int]) -> None:
        """Mark what a node that lives on has lost; a destroyed node has lost everything."""
        if not present:
            return
        for record in self.all_entities:
            if record.node == owner.number and not record.destroyed:
                record.destroyed = record.complete and record.number not in present

    def _look_at_executor(self, record: ExecutorRecord) -> None:
        executor = record.ref()
        if executor is None:
            return
        record.threads = thread_count(executor)
        waited = has_waited(executor)
        for node in self.all_nodes:
            for stay in node.stays:
                if stay.until is None and stay.executor == record.number:
                    stay.waited = stay.waited or waited
