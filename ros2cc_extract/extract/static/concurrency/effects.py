"""What a callback does while it is followed: it locks, reads, writes, publishes."""

from __future__ import annotations

import ast
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.accesses import (
    collection_aliases,
    iterations,
    kept_threads,
    lost_notifications,
    refreshed,
    signal_locks,
    torn_state,
    torn_updates,
)
from ros2cc_extract.extract.static.concurrency.accesses.flags import claims, flag_locks
from ros2cc_extract.extract.static.concurrency.accesses.held_locks import (
    is_counter,
    lock_of,
    taking_of,
)
from ros2cc_extract.extract.static.concurrency.accesses.holders import (
    closure_cells,
    data_kinds,
    loose_data,
)
from ros2cc_extract.extract.static.concurrency.waits import outside_waits, values_during_waits
from ros2cc_extract.extract.static.concurrency.waits.blocking_calls import Waits, is_main, touch
from ros2cc_extract.extract.static.program.text_queries import unmangled
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, Looked
from ros2cc_extract.extract.static.python.machine.world import (
    ITSELF,
    RECENT,
    AccessKind,
    note_once,
)
from ros2cc_extract.extract.static.python.objects.element_keys import note_item
from ros2cc_extract.extract.static.python.values.containers import (
    Collection,
    Fields,
    collection_class,
)
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Class,
    Const,
    Function,
    Heaped,
    Instance,
    Library,
    Module,
    Mystery,
    Native,
    Scope,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import EMPTIES, FLAG, SHARED, Access, Act
from ros2cc_extract.spec.model import When
from ros2cc_extract.spec.program_order import steps

_CODE = (Module, Library, Class, Function)
_OF_CONTENT = (AccessKind.READ, AccessKind.UPDATE_IN_PLACE)
_RE_ENTRANT = ('rlock', 'condition')
_LOCKS = frozenset({'lock', 'rlock', 'condition', 'semaphore'})


class Effects(Waits):
    """Notes for the callback or activity that is being followed; nothing while there is none."""

    def note_attribute(self, owner: Value, name: str, kind: AccessKind, place: Place) -> None:
        """
        An attribute is touched.

        Methods, entities and locks are no shared data, and neither is an object that this
        callback has made.
        """
        if self.world.effects is None and kind is AccessKind.WRITE:
            self._note_other_write(owner, name, place)
        if self.world.effects is None:
            return
        if self.world.effects.looked is not None:
            self._note_look(self.world.effects.looked, owner, name, place)
        if not isinstance(owner, (Instance, Class)):
            self._note_loose(owner, name, kind, place)
            return
        if self.world.activity is not None and isinstance(owner, Instance):
            touch(self.world.activity, owner)
        cls = owner.cls if isinstance(owner, Instance) else owner
        if not isinstance(cls, Class) or self._is_behaviour(owner, name, kind, place):
            return
        attribute = unmangled(name, cls.name)
        shown = f'{collection_aliases.object_name(owner, cls)}.{attribute}'
        is_own = isinstance(owner, Instance) and owner.born is self.world.effects
        home = collection_aliases.home_of(self.world, owner, name) if kind in _OF_CONTENT else None
        if home is not None and home[1] != shown:
            shown, is_own = self._seen_at(home), False
        if kind is AccessKind.WITHIN or (is_own and kind is not AccessKind.READ):
            self.world.effects.own.append(shown)
        elif not is_own:
            self._note_access(shown, kind, place, attribute)

    def _note_loose(self, owner: Value, name: str, kind: AccessKind, place: Place) -> None:
        """An attribute of a module, of a function, or of an object that is not scanned."""
        shown = loose_data.shown(self.world, owner, name, is_read=kind is AccessKind.READ)
        if shown is not None and kind is not AccessKind.WITHIN:
            self._note_access(shown, kind, place, name)

    def _note_look(self, looked: Looked, owner: Value, name: str, place: Place) -> None:
        """A test of a loop asks for an attribute, perhaps of what others may change."""
        if isinstance(owner, Mystery) and owner.unknown in self.world.outside_objects:
            looked.outside.append(owner.unknown)
        elif isinstance(owner, Instance) and isinstance(owner.cls, Class):
            looked.holders.append((owner, name))
        elif isinstance(owner, Instance) and isinstance(owner.cls, Library):
            found = self.attribute(owner, name, place)
            if isinstance(found, Mystery):
                looked.outside.append(found.unknown)

    def _seen_at(self, home: collection_aliases.Home) -> str:
        """Note the first holder of a collection: code that touches one touches the other."""
        owner, shown = home
        if self.world.activity is not None and isinstance(owner, Instance):
            touch(self.world.activity, owner)
        return shown

    def note_replaced(self, owner: Value, name: str, old: Value) -> None:
        """Callbacks that have run may have met it."""
        values_during_waits.note_replaced(self.world, owner, name, old)

    def note_held(self, owner: Value, name: str, value: Value) -> None:
        """An attribute has got a value: a collection is known by the first one that holds it."""
        kept_threads.note_stored(self.world, owner, name, value)
        if isinstance(owner, Heaped):
            values_during_waits.note_kept(self.world, owner, name, value)
        if isinstance(owner, Instance) and isinstance(owner.cls, Class):
            whose = collection_aliases.object_name(owner, owner.cls)
            shown = f'{whose}.{unmangled(name, owner.cls.name)}'
            collection_aliases.note_held(self.world, owner, name, value, shown)
            torn_updates.note_held(self.world, owner, name, value, shown)
        elif isinstance(owner, (Function, Module)):
            loose_data.note_held(self.world, owner, name, value)
        elif isinstance(owner, Mystery):
            loose_data.note_member(self.world, owner, name, value)

    def _note_other_write(self, owner: Value, name: str, place: Place) -> None:
        """Code without a known caller, or that runs after the spin, writes an attribute."""
        cls = owner.cls if isinstance(owner, Instance) else owner
        if isinstance(cls, Class):
            whose = collection_aliases.object_name(owner, cls)  # type: ignore[arg-type]
            self._note_late_write(f'{whose}.{unmangled(name, cls.name)}', place)

    def _note_late_write(self, shown: str, place: Place) -> None:
        world = self.world
        is_late = world.when is When.LATER or world.after_spin
        if not (is_late or world.is_beside_others):
            return
        outside_waits.note_write(world, shown)
        function = self.stack[0].name if self.stack else ''
        by = function if world.when is When.LATER else None
        if is_late:
            world.other_writes.setdefault(shown, (by, place))
        else:
            world.writes_beside.setdefault(shown, place)

    def _note_access(
        self, name: str, kind: AccessKind, place: Place, attribute: str | None = None
    ) -> None:
        effects = self.world.effects
        if effects is None:
            return
        is_read, reading = kind is AccessKind.READ, self.world.reading
        is_stored, is_content = kind is AccessKind.WRITE, kind is AccessKind.UPDATE_IN_PLACE
        if is_read:
            reading.note_read(name)
        at, flows = (place, attribute or name.rpartition('.')[2]), name in reading.flowing
        choices = flows or name in reading.choices.get(at, ())
        chosen = is_content and (choices or bool(self.world.given_from & {name, ITSELF}))
        is_tested = (reading.leads_to if is_content else reading.governs)(name, self.world.path)
        is_tested = is_tested and not (is_stored and refreshed.is_known(self.world, name, place))
        rests = (is_tested or flows or chosen) and not self.world.by_local
        is_used = rests and is_read and at in reading.used
        # What is imported is the same each time, whatever was found before.
        is_import = isinstance(reading.stored, (Library, Module))
        if kind is AccessKind.WRITE:
            flag_locks.put_up(self.world, name)
        joins, is_akin = torn_state.written_with(self.world, name, reading.items.get(at), kind)
        access = Access(
            name=name,
            source=place,
            locks=self.world.held,
            update=kind in (AccessKind.UPDATE, AccessKind.UPDATE_IN_PLACE),
            in_place=is_content,
            whole=not (is_content or is_read) and reading.is_in_one_piece(name, self.world.path),
            keeps_size=self.world.refilling,
            moves=EMPTIES if data_kinds.is_emptied(kind, reading.stored) else self.world.moves,
            iterates=self.world.iterating,
            item=reading.items.get(at),
            chosen=chosen,
            rests=is_used or (rests and not (is_read or (is_stored and is_import))),
            bare=not rests and data_kinds.is_bare(self.world, is_content or at in reading.used),
            compared=is_read and at in reading.compared,
            asked=is_read and at in reading.asked_for and name in effects.storers,
            fresh=is_read and self.world.is_fresh(name, self.stack),
            later=self._is_late(name, is_used=is_used or (is_content and is_tested), kind=kind),
            clears=is_stored and reading.stored == NONE,
            lowers=is_stored and reading.stored != NONE and data_kinds.is_false(reading.stored),
            fills_none=is_stored and reading.fills_none and is_main(self.world.activity),
            found=reading.found_of(name, self.world.path, self.world.laps) if is_stored else None,
            constant=is_stored and rests and isinstance(reading.stored, Const),
            literal=is_stored and bool(self.world.literals.get(place)),
            at_once=is_stored and rests and claims.is_at_once(self.world, name),
            joins=joins,
            akin=is_akin,
            turn=() if is_read or is_content else self._turn_of_store(),
            chain=self.world.chain[1:],
        )
        _note_closer(effects.reads if is_read else effects.writes, access)
        if kind is AccessKind.WRITE:
            refreshed.note_stored(self.world, access)
            self.world.note_stored(name, self.stack)
            flag_locks.put_down(self.world, name)
            reading.forget(name, self.world.path)
        if not is_read:
            self._note_written(effects, name, place)

    def _is_late(self, name: str, *, is_used: bool, kind: AccessKind) -> bool:
        """Whether others have surely been let in between what was read before and this."""
        world, reading = self.world, self.world.reading
        if is_used or kind is not AccessKind.WRITE:
            return is_used and reading.has_called_since(name, world.path)
        if name in reading.flowing:
            return reading.has_called_since_read(name)
        begun = world.effects.begun if world.effects is not None else 0
        return reading.has_run_since(name, world.path, begun, begun - len(self.stack))

    def _turn_of_store(self) -> tuple[Place, ...]:
        waited = self.world.reading.waited
        return () if waited is None else (*self.world.chain[1:], waited)

    def _note_written(self, effects: EffectLog, name: str, place: Place) -> None:
        self.world.note_done(name, place)
        for hold in lost_notifications.holds_of(self.world):
            effects.stored.setdefault(hold, set()).add(name)

    def note_iteration(self, node: ast.expr, frame: Frame, how: str | None = None) -> None:
        """Code goes over what ``node`` gives; over a copy of it nothing happens."""
        if self.world.effects is None:
            return
        for target in iterations.iterated(node):
            if isinstance(target, ast.Call) and not self._is_getter(target, frame):
                continue
            noted, self.world.effects = self.world.effects, None
            values = options_of(self.evaluate(target, frame))
            self.world.effects = noted
            kinds = [collection_class(v) for v in values if isinstance(v, Collection)]
            self.world.iterating = (how or kinds[0]) if kinds else None
            if kinds:
                self.note_update(target, frame, AccessKind.READ)
            self.world.iterating = None

    def _is_getter(self, node: ast.Call, frame: Frame) -> bool:
        """A call that does nothing but give what an attribute holds."""
        noted, self.world.effects = self.world.effects, None
        function = self.evaluate(node.func, frame)
        self.world.effects = noted
        return isinstance(function, Bound) and collection_aliases.is_getter(function.function)

    def note_update(self, target: ast.expr, frame: Frame, kind: AccessKind) -> None:
        """The object in a name or attribute gets a new content or value from its old one."""
        if self.world.effects is None:
            return
        place = frame.place(target)
        if isinstance(target, ast.Subscript) and isinstance(target.value, ast.Call):
            self._note_field(target, frame, kind)
        elif isinstance(target, ast.Subscript):
            note_item(self, target.value, target.slice, frame)
            self.note_update(target.value, frame, kind)
        elif isinstance(target, ast.Attribute):
            of_loop, self.world.iterating = self.world.iterating, None
            owners = options_of(self.evaluate(target.value, frame))
            self.world.iterating, name = of_loop, frame.attribute_name(target.attr)
            if any(collection_aliases.is_property(owner, name) for owner in owners):
                self._note_given(target, target.attr, frame, kind)
                return
            for owner in owners:
                self.note_attribute(owner, name, kind, place)
        elif isinstance(target, ast.Call):
            self._note_given(target, '', frame, kind)
        elif isinstance(target, ast.Name) and self._is_global(target.id, frame):
            self.note_global(frame.module, target.id, kind, place)
        elif isinstance(target, ast.Name):
            self._note_variable(target, frame, kind)

    def _note_field(self, target: ast.Subscript, frame: Frame, kind: AccessKind) -> None:
        """``vars(self)['n']``, ``globals()['n']``: one attribute or variable, by its name."""
        noted, self.world.effects = self.world.effects, None
        held = self.evaluate(target.value, frame)
        self.world.effects = noted
        key, place = target.slice, frame.place(target)
        name = str(key.value) if isinstance(key, ast.Constant) else '…'
        if isinstance(held, Fields):
            self.note_attribute(held.owner, name, kind, place)
        elif ast.unparse(target.value) == 'globals()':
            is_whole = kind is not AccessKind.UPDATE_IN_PLACE
            changed = kind if is_whole else AccessKind.WRITE
            self._note_access(f'{frame.module.name}.{name}', changed, place, name)
        else:
            note_item(self, target.value, target.slice, frame)
            self.note_update(target.value, frame, kind)

    def _note_variable(self, target: ast.Name, frame: Frame, kind: AccessKind) -> None:
        """A local name stands for what an attribute holds, or is shared with inner functions."""
        place, owner = frame.place(target), closure_cells.owner_of(target.id, frame)
        is_known = self._note_given(target, target.id, frame, kind)
        if owner is not None and not is_known:
            self.note_cell(owner, target.id, kind, place)

    def _note_given(
        self, target: ast.expr, attribute: str, frame: Frame, kind: AccessKind
    ) -> bool:
        """What a name, a property or a getter gives is what an attribute holds; is it known?"""
        if kind is AccessKind.WRITE or not (self.world.homes or self.world.lent):
            return False
        noted, self.world.effects = self.world.effects, None
        held = self.evaluate(target, frame)
        self.world.effects = noted
        is_content = self.world.iterating is not None or kind is AccessKind.UPDATE_IN_PLACE
        homes = collection_aliases.homes_of(self.world, held)
        lenders = collection_aliases.lenders_of(self.world, held) if is_content else []
        for home in (*homes, *lenders):
            self.world.by_local = isinstance(target, ast.Name) and home in lenders
            self._note_access(self._seen_at(home), kind, frame.place(target), attribute)
        self.world.by_local = False
        return bool(homes or lenders)

    def _is_global(self, name: str, frame: Frame) -> bool:
        return closure_cells.owner_of(name, frame) is None and name in frame.module.slots

    def _is_behaviour(
        self, owner: Instance | Class, name: str, kind: AccessKind, place: Place
    ) -> bool:
        """Methods, entities and locks are no shared data, and neither is what has ``__get__``."""
        value = owner.slots.get(name)
        if value is None:
            cls = owner.cls if isinstance(owner, Instance) else owner
            held = [c.slots[name] for c in data_kinds.classes_of(cls) if name in c.slots]
            if not held:
                is_stored = kind in (AccessKind.WRITE, AccessKind.UPDATE)
                return not is_stored and not data_kinds.is_assigned(cls, name)
            is_code = isinstance(held[0], (Function, Native, Class))
            return is_code or self.special_method(held[0], '__get__', place) is not None
        if data_kinds.is_replaced(owner, name) or data_kinds.is_member(owner, value):
            return data_kinds.is_member(owner, value)
        return any(
            isinstance(option, (Bound, Function, Native, Class))
            or (isinstance(option, Instance) and option.state is not None)
            for option in options_of(value)
        )

    def note_global(self, module: Module, name: str, kind: AccessKind, place: Place) -> None:
        """A global is touched; only those count that some function changes."""
        if self.world.effects is None or name not in self.changed_globals(module):
            return
        if kind is AccessKind.WITHIN:
            self.world.effects.own.append(f'{module.name}.{name}')
            return
        value = module.slots.get(name)
        if isinstance(value, Instance) and value.state is not None:
            return
        options = [o for o in options_of(value) if o != NONE] if isinstance(value, Value) else []
        if options and all(isinstance(option, _CODE) for option in options):
            return
        home = self.world.homes.get(value) if kind in _OF_CONTENT else None  # type: ignore[arg-type]
        shown = f'{module.name}.{name}' if home is None else self._seen_at(home)
        self._note_access(shown, kind, place, name)

    def note_cell(self, scope: Scope, name: str, kind: AccessKind, place: Place) -> None:
        """A variable is touched; what is made in this run is shared only with later code."""
        world, effects = self.world, self.world.effects
        shown = closure_cells.shown_cell(world, scope, name)
        if shown is None:
            home = (
                loose_data.home_of_local(world, scope, name) if kind is AccessKind.READ else None
            )
            if home is not None:
                self._note_access(home, kind, place, name)
            return
        is_own = effects is not None and scope.born is effects
        if effects is None:
            if kind is not AccessKind.READ:
                self._note_late_write(shown, place)
        elif kind is AccessKind.WITHIN or (is_own and kind is not AccessKind.READ):
            effects.own.append(shown)
        elif not is_own:
            self._note_access(shown, kind, place, name)

    def note_acquire(self, lock: Value, place: Place, *, may_fail: bool = False) -> None:
        """A lock is taken; with a time-out it may not be."""
        for option in map(lock_of, options_of(lock)):
            if (
                isinstance(option, Instance)
                and isinstance(option.state, PlainState)
                and option.state.kind in _LOCKS
                and not is_counter(self.world, option)
            ):
                name = self.lock_name(option, option.state.kind)
                signal_locks.note_taken(self.world, option)
                if name in self.world.held and option.state.kind in _RE_ENTRANT:
                    self.world.held = (*self.world.held, name)
                    continue  # its holder takes it once more and does not wait
                act = Act(
                    name=name,
                    source=place,
                    chain=self.world.chain[1:],
                    held=() if may_fail else self._held_meanwhile(name, option.state.kind),
                    tries=may_fail,
                )
                self.world.held = (*self.world.held, name)
                self.world.loops_at[name] = self.world.open_loops
                lost_notifications.begin_hold(self.world, name)
                if self.world.effects is not None:
                    note_once(self.world.effects.locks, act)
                    if self.world.path == self.world.callback_path and not may_fail:
                        self.world.effects.taken.setdefault(name, steps(act))
                self._note_in_main(name, place)

    def _note_in_main(self, name: str, place: Place) -> None:
        """A handler of a signal may interrupt the main program while it holds the lock."""
        world = self.world
        is_of_main = world.effects is None or is_main(world.activity)
        if is_of_main and not world.in_thread and world.signal_handlers:
            take = (name, place, len(world.signal_handlers))
            if take not in world.main_takes:
                world.main_takes.append(take)

    def lock_name(self, lock: Instance, kind: str) -> str:
        """The name that a lock is stored under; a second one of that name gets a number."""
        hint = lock.hint or kind
        known = self.world.locks.setdefault(hint, [])
        if lock not in known:
            known.append(lock)
        number = known.index(lock)
        return hint if number == 0 else f'{hint}#{number + 1}'

    def _held_meanwhile(self, name: str, kind: str) -> tuple[str, ...]:
        """
        The locks that are kept while this one is waited for.

        Source: ``threading.py``; only ``Lock`` waits for its own holder, and a ``Condition``
        holds an ``RLock``.
        """
        held = (lock for lock in self.world.held if not lock.endswith((SHARED, FLAG)))
        return tuple(dict.fromkeys(lock for lock in held if lock != name or kind == 'lock'))

    def note_release(self, lock: Value) -> None:
        """A lock is given back."""
        for option in map(lock_of, options_of(lock)):
            if isinstance(option, Instance) and isinstance(option.state, PlainState):
                given_back = self.lock_name(option, option.state.kind)
                held = [name for name in self.world.held if name != given_back]
                self.world.held = tuple(held)

    def note_lock_method(self, owner: Value, name: str) -> None:
        """``owner.acquire…`` or ``release…`` of a class of the program that holds a lock."""
        if not isinstance(owner, Instance) or not data_kinds.holds_lock(owner):
            return
        lock = self.lock_name(owner, owner.class_name)
        if name.startswith(('acquire', '__enter__')):
            is_shared = 'read' in name or 'shared' in name
            self.world.held = (*self.world.held, lock + SHARED if is_shared else lock)
        elif name.startswith('release'):
            given_back = (lock, lock + SHARED)
            self.world.held = tuple(held for held in self.world.held if held not in given_back)

    def note_entered(self, value: Instance, place: Place) -> None:
        """Locks are held inside of a ``with``."""
        if _is_semaphore(value):
            self.note_blocking(taking_of(self.world, value), value, None, place)
        elif is_counter(self.world, value):
            self.note_blocking('Lock.acquire', value, None, place)
        self.note_acquire(value, place)


def _note_closer(accesses: list[Access], access: Access) -> None:
    """Note an access, in place of what is known of it as that of no loop."""
    plain = replace(access, iterates=None)
    if plain != access and plain in accesses[-RECENT:]:
        accesses.remove(plain)
    note_once(accesses, access)


def _is_semaphore(value: Instance) -> bool:
    return isinstance(value.state, PlainState) and value.state.kind == 'semaphore'
