"""What a callback does while it is followed: it blocks, locks, reads, writes, publishes."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace

from ros2cc_extract.extract.static import outside_waits
from ros2cc_extract.extract.static.containers import Collection, collection_class
from ros2cc_extract.extract.static.held_locks import held_over
from ros2cc_extract.extract.static.machine import Frame, Machine
from ros2cc_extract.extract.static.relevance import reassigned_attributes, unmangled
from ros2cc_extract.extract.static.values import (
    NONE,
    Bound,
    Call,
    Class,
    Const,
    Coroutine,
    Function,
    Instance,
    Library,
    Module,
    Mystery,
    Native,
    Scope,
    Value,
    options_of,
)
from ros2cc_extract.extract.static.world import (
    RECENT,
    AccessKind,
    EntityRef,
    EntityState,
    ExecutorState,
    NodeState,
    PlainState,
    SettableRef,
    note_once,
)
from ros2cc_extract.places import Place, Unknown
from ros2cc_extract.spec.deeds import SHARED, Access, Act, Blocking

_CODE = (Module, Library, Class, Function)
_SETTABLE = frozenset({'event', 'future'})
_LOCKS = frozenset({'lock', 'rlock', 'condition', 'semaphore'})


def _shared(lock: str) -> bool:
    return lock.endswith(SHARED)


class Effects(Machine):
    """Notes for the callback that is being followed; nothing while there is none."""

    def note_attribute(self, owner: Value, name: str, kind: AccessKind, place: Place) -> None:
        """
        An attribute is touched.

        Methods, entities and locks are no shared data, and neither is an object that this
        callback has made.
        """
        if self.world.deeds is None or not isinstance(owner, (Instance, Class)):
            return
        cls = owner.cls if isinstance(owner, Instance) else owner
        if not isinstance(cls, Class) or self._is_behaviour(owner, name):
            return
        if isinstance(owner, Instance) and owner.born is self.world.deeds:
            return
        shown = unmangled(name, cls.name)
        self._note_access(f'{_object_name(owner, cls)}.{shown}', kind, place)

    def _note_access(self, name: str, kind: AccessKind, place: Place) -> None:
        deeds = self.world.deeds
        if deeds is None:
            return
        is_read = kind is AccessKind.READ
        access = Access(
            name=name,
            source=place,
            locks=self.world.held,
            update=kind in (AccessKind.UPDATE, AccessKind.UPDATE_IN_PLACE),
            in_place=kind is AccessKind.UPDATE_IN_PLACE,
            keeps_size=self.world.refilling,
            iterates=self.world.iterating,
            chain=self.world.chain[1:],
        )
        accesses = deeds.reads if is_read else deeds.writes
        if access.iterates is not None:
            plain = replace(access, iterates=None)
            if plain in accesses[-RECENT:]:
                accesses.remove(plain)
        note_once(accesses, access)

    def note_iteration(self, node: ast.expr, frame: Frame) -> None:
        """A loop goes over what ``node`` gives; over a copy of it nothing happens."""
        if self.world.deeds is None:
            return
        for target in _iterated(node):
            noted, self.world.deeds = self.world.deeds, None
            values = options_of(self.evaluate(target, frame))
            self.world.deeds = noted
            kinds = [collection_class(v) for v in values if isinstance(v, Collection)]
            self.world.iterating = kinds[0] if kinds else None
            if kinds:
                self.note_update(target, frame, AccessKind.READ)
            self.world.iterating = None

    def note_update(self, target: ast.expr, frame: Frame, kind: AccessKind) -> None:
        """The object in a name or attribute gets a new content or value from its old one."""
        if self.world.deeds is None:
            return
        place = frame.place(target)
        if isinstance(target, ast.Subscript):
            self.note_update(target.value, frame, kind)
        elif isinstance(target, ast.Attribute):
            for owner in options_of(self.evaluate(target.value, frame)):
                self.note_attribute(owner, frame.attribute_name(target.attr), kind, place)
        elif isinstance(target, ast.Name) and self._is_global(target.id, frame):
            self.note_global(frame.module, target.id, kind, place)

    def _is_global(self, name: str, frame: Frame) -> bool:
        scope: Scope | None = frame.scope
        while scope is not None:
            if name in scope.slots and name not in scope.global_names:
                return False
            scope = scope.parent
        return name in frame.module.slots

    def _is_behaviour(self, owner: Instance | Class, name: str) -> bool:
        """Methods, entities and locks are no shared data."""
        value = owner.slots.get(name)
        if value is None:
            cls = owner.cls if isinstance(owner, Instance) else owner
            held = [
                c.slots[name]
                for c in getattr(cls, 'mro', ())
                if isinstance(c, Class) and name in c.slots
            ]
            if not held:
                return not _is_assigned(cls, name)
            return isinstance(held[0], (Function, Native, Class))
        return any(
            isinstance(option, (Bound, Function, Native, Class))
            or (isinstance(option, Instance) and option.state is not None)
            for option in options_of(value)
        )

    def note_global(self, module: Module, name: str, kind: AccessKind, place: Place) -> None:
        """A global is touched; only those count that some function changes."""
        if self.world.deeds is None or name not in self.changed_globals(module):
            return
        value = module.slots.get(name)
        if isinstance(value, Instance) and value.state is not None:
            return
        options = [o for o in options_of(value) if o != NONE] if isinstance(value, Value) else []
        if options and all(isinstance(option, _CODE) for option in options):
            return
        self._note_access(f'{module.name}.{name}', kind, place)

    def note_loop(self, node: ast.While, frame: Frame) -> None:
        """
        A ``while`` loop begins; one that only waits for a future is a busy wait.

        A coroutine that awaits in each round gives its thread back, as one that awaits the future.
        """
        deeds = self.world.deeds
        if deeds is None and not outside_waits.is_idle(node):
            return
        gives_back = deeds is not None and outside_waits.awaits_each_round(node)
        place, is_known = frame.place(node), False
        for part in ast.walk(node.test):
            if (
                isinstance(part, ast.Call)
                and isinstance(part.func, ast.Attribute)
                and part.func.attr in ('done', 'is_set', 'wait_for_service', 'service_is_ready')
            ):
                owner = self.evaluate(part.func.value, frame)
                is_known = True
                if part.func.attr in ('done', 'is_set'):
                    self.note_blocking('await' if gives_back else 'busy wait', owner, None, place)
        if deeds is not None and not is_known and outside_waits.spins(node):
            # How many callbacks run before it ends is not one.
            reason = f'what ends the loop: {ast.unparse(node.test)}'
            self.note_blocking('busy wait', self.mystery(reason, place), None, place)

    def note_blocking(
        self, name: str, on: Value | None, seconds: Value | None, place: Place
    ) -> None:
        """A call that can hold its thread."""
        deeds = self.world.deeds
        if deeds is None:
            self.note_outside_wait(name, on, seconds, place)
            return
        block = Blocking(
            call=name,
            source=place,
            on=self._waited_for(on),
            seconds=_seconds(seconds, place),
            chain=self.world.chain[1:],
            held=held_over(self.world, on),
        )
        if not any(_is_same_wait(block, other) for other in deeds.blocking[-RECENT:]):
            deeds.blocking.append(block)

    def note_outside_wait(
        self,
        name: str,
        on: Value | None,
        seconds: Value | None,
        place: Place,
        spun: tuple[Instance, ...] = (),
    ) -> None:
        """Code that is no callback waits for ``on`` and spins some nodes meanwhile."""
        if isinstance(on, Instance) and seconds in (None, NONE):
            outside_waits.note(self.world, name, on, place, spun)

    def _waited_for(self, value: Value | None) -> str | Unknown | None:
        if value is None or value == NONE:
            return None
        if isinstance(value, Mystery):
            return value.unknown
        if isinstance(value, Instance):
            state = value.state
            source = state.of if isinstance(state, PlainState) and state.of else value
            if isinstance(source, Instance) and isinstance(source.state, EntityState):
                return EntityRef.to(source.state)
            if isinstance(state, PlainState) and state.kind in _SETTABLE:
                return SettableRef.to_object(value, value.hint or value.class_name)
            if isinstance(value.state, (NodeState, ExecutorState)):
                return EntityRef.to_object(value, value.hint or value.class_name)
            return value.hint or value.class_name
        return None

    def note_await(self, value: Value, place: Place) -> None:
        """A callback awaits ``value``; awaiting its own coroutine is only a call."""
        if not isinstance(value, Coroutine):
            self.note_blocking('await', value, None, place)

    def note_acquire(self, lock: Value, place: Place, *, may_fail: bool = False) -> None:
        """A lock is taken; with a time-out it may not be."""
        for option in options_of(lock):
            if (
                isinstance(option, Instance)
                and isinstance(option.state, PlainState)
                and option.state.kind in _LOCKS
            ):
                name = self._lock_name(option, option.state.kind)
                act = Act(
                    name=name,
                    source=place,
                    chain=self.world.chain[1:],
                    held=() if may_fail else self._held_meanwhile(name, option.state.kind),
                    tries=may_fail,
                )
                self.world.held = (*self.world.held, name)
                if self.world.deeds is not None:
                    note_once(self.world.deeds.locks, act)

    def _lock_name(self, lock: Instance, kind: str) -> str:
        """The name it is stored under; a second lock of that name gets a number."""
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
        held = (lock for lock in self.world.held if not _shared(lock))
        return tuple(dict.fromkeys(lock for lock in held if lock != name or kind == 'lock'))

    def note_release(self, lock: Value) -> None:
        """A lock is given back."""
        for option in options_of(lock):
            if isinstance(option, Instance) and isinstance(option.state, PlainState):
                given_back = self._lock_name(option, option.state.kind)
                held = [name for name in self.world.held if name != given_back]
                self.world.held = tuple(held)

    def note_lock_method(self, owner: Value, name: str) -> None:
        """``owner.acquire…`` or ``release…`` of a class of the program that holds a lock."""
        if not isinstance(owner, Instance) or not _holds_lock(owner):
            return
        lock = self._lock_name(owner, owner.class_name)
        if name.startswith(('acquire', '__enter__')):
            is_shared = 'read' in name or 'shared' in name
            self.world.held = (*self.world.held, lock + SHARED if is_shared else lock)
        elif name.startswith('release'):
            given_back = (lock, lock + SHARED)
            self.world.held = tuple(held for held in self.world.held if held not in given_back)

    def note_set(self, thing: Value) -> None:
        """An event or future is set, by the callback that is followed or by something else."""
        setter = self.world.current if self.world.deeds is not None else None
        for option in options_of(thing):
            self.world.setters.setdefault(id(option), []).append(setter)
            self.world.set_in_threads[id(option)] += setter is None and self.world.in_thread

    def note_publish(self, publisher: Value, place: Place) -> None:
        """A message is published."""
        deeds = self.world.deeds
        if deeds is None or not isinstance(publisher, Instance):
            return
        key = publisher.state.key if isinstance(publisher.state, PlainState) else None
        name: str | Unknown = Unknown('topic that could not be followed', place)
        if isinstance(key, Const):
            name = str(key.value)
        elif isinstance(key, Mystery):
            name = key.unknown
        note_once(deeds.publishes, Act(name=name, source=place, chain=self.world.chain[1:]))

    def note_nested_spin(
        self,
        how: str,
        node: Instance | None,
        executor: Value,
        future: tuple[Value | None, Value | None],
        place: Place,
        change: str = '',
    ) -> bool:
        """Whether a spin stands in a callback; then it is noted there and is no set-up."""
        if self.world.deeds is None:
            return False
        awaited, timeout = future
        spun = executor if node is None else node
        self.note_blocking(how, spun, timeout if awaited is None else None, place)
        if awaited is not None:
            self.note_blocking('spin for future', awaited, timeout, place)
        if node is not None:
            self.note_change(change, node, place)
        return True

    def note_change(self, what: str, node: Instance, place: Place) -> None:
        """A callback changes which executor serves ``node``."""
        if self.world.deeds is not None:
            act = Act(name=what, source=place, chain=self.world.chain[1:])
            note_once(self.world.deeds.changes, act)

    def enter_context(self, value: Value, place: Place) -> Value:
        """What ``with value as x`` binds to ``x``; locks are held inside."""
        if isinstance(value, Instance):
            if isinstance(value.state, (PlainState, ExecutorState)):
                self.note_acquire(value, place)
                return value
            method = self.attribute(value, '__enter__', place)
            if isinstance(method, Bound):
                entered = self.call(method, Call(place))
                self.note_lock_method(value, '__enter__')
                return entered
            return value
        return value


_VIEWS = frozenset({'items', 'keys', 'values'})
_PASSING_ON = frozenset({'enumerate', 'zip', 'reversed', 'iter', 'map', 'filter'})


def _iterated(node: ast.expr) -> Iterator[ast.expr]:
    """What a loop over ``node`` goes over, by the names it is known under."""
    if isinstance(node, (ast.Attribute, ast.Name)):
        yield node
    elif isinstance(node, ast.Call):
        function = node.func
        if isinstance(function, ast.Attribute) and function.attr in _VIEWS:
            yield from _iterated(function.value)
        elif isinstance(function, ast.Name) and function.id in _PASSING_ON:
            for argument in node.args:
                yield from _iterated(argument)


def _holds_lock(owner: Instance) -> bool:
    return owner.state is None and any(
        isinstance(option, Instance)
        and isinstance(option.state, PlainState)
        and option.state.kind in _LOCKS
        for held in owner.slots.values()
        if isinstance(held, Value)
        for option in options_of(held)
    )


def _is_assigned(cls: Value, name: str) -> bool:
    """Whether a method assigns the attribute that nobody has made yet."""
    return any(
        name in reassigned_attributes(base.node)
        for base in getattr(cls, 'mro', ())
        if isinstance(base, Class)
    )


def _is_same_wait(one: Blocking, other: Blocking) -> bool:
    """References to two entities are equal as texts."""
    numbers = [block.on.number for block in (one, other) if isinstance(block.on, EntityRef)]
    return one == other and len(set(numbers)) < 2


def _object_name(owner: Instance | Class, cls: Class) -> str:
    """The class; helper objects of one class are told apart, nodes are by their callbacks."""
    is_helper = isinstance(owner, Instance) and owner.state is None and owner.number > 1
    return f'{cls.name}#{owner.number}' if is_helper else cls.name  # type: ignore[union-attr]


def _seconds(value: Value | None, place: Place) -> float | Unknown | None:
    if value is None or value == NONE:
        return None
    if isinstance(value, Const) and isinstance(value.value, (int, float)):
        return float(value.value)
    if isinstance(value, Mystery):
        return value.unknown
    return Unknown('a duration that could not be followed', place)
