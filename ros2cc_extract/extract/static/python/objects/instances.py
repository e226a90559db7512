"""How objects of scanned classes are made: ``__new__``, then ``__init__``."""

from __future__ import annotations

from functools import partial

from ros2cc_extract.extract.static.python.machine.library_state import LibraryState
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.objects import memoization, reanalysis
from ros2cc_extract.extract.static.python.objects.allocation_sites import made_before, remember
from ros2cc_extract.extract.static.python.objects.dataclass_fields import fill_fields, is_dataclass
from ros2cc_extract.extract.static.python.objects.library_calls import CALLING_BACK, is_standard
from ros2cc_extract.extract.static.python.objects.metaclasses import scanned_new
from ros2cc_extract.extract.static.python.values import enumerations
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Class,
    Function,
    Instance,
    Library,
    Native,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place

_MADE = '__made__'


class Instances(Machine):
    """
    Making objects.

    :ivar creating: the calls of classes whose ``__new__`` is running.
    :ivar beginning: the objects whose ``__init__`` is running.
    """

    creating: list[tuple[Class, Call]]
    beginning: list[Instance]

    def instantiate(self, cls: Class, call: Call) -> Value:
        """What ``type.__call__`` gives: an object from ``__new__``, after its ``__init__``."""
        known = reanalysis.made_then(self.world, cls, call.place)
        known = known or self._made_by_looking(cls, call.place) or made_before(self, cls, call)
        if known is not None:
            reanalysis.remember(self.world, cls, call.place, known)
            return known
        member = enumerations.made(cls, call)
        return member or memoization.doubted(self, cls, call, partial(self._make, cls))

    def _make(self, cls: Class, call: Call) -> Value:
        new = scanned_new(cls)
        if new is None:
            return self._begun(cls, call, self.allocate(cls, call))
        self.creating.append((cls, call))
        try:
            made = self.call(new, call.bound_to(cls))
        finally:
            self.creating.pop()
        if all(isinstance(option, Instance) for option in options_of(made)):
            return self.each(made, partial(self._begun, cls, call), call.place)
        return self._made_otherwise(cls, new, call)

    def _made_otherwise(self, cls: Class, new: Function, call: Call) -> Value:
        """``__new__`` gives something that could not be followed: perhaps what was made before."""
        instance = self.allocate(cls, call)
        if isinstance(instance.state, LibraryState):
            reason = f'what __new__ of {cls.name} gives could not be followed'
            instance.state.doubt(reason, new.place)
        return self._begun(cls, call, instance)

    def allocate(self, cls: Class, call: Call) -> Instance:
        """A new object of ``cls``, as ``object.__new__`` makes it."""
        made_for = next((call for made, call in reversed(self.creating) if made is cls), call)
        instance = Instance(cls, made_for.place)
        reanalysis.remember(self.world, cls, made_for.place, instance)
        if self.world.looking:
            site = (self.world.looking[-1:], cls, made_for.place)
            self.world.made_by_looking[site] = instance
            self.store.write(instance, _MADE, NONE)
        instance.path = self.world.path
        instance.born = self.world.effects
        if self.beginning:
            reanalysis.note_part(self.world, self.beginning[-1], instance)
        instance.number += self.world.made_of[cls]
        self.world.made_of[cls] += 1
        self.prepare(instance)
        remember(self, instance, made_for)
        self.world.instances.append(instance)
        return instance

    def _begun(self, cls: Class, call: Call, made: Value) -> Value:
        """Run ``__init__`` on what ``__new__`` gave, unless that is of another class."""
        if not isinstance(made, Instance) or cls not in made.mro:
            return made
        init = self.attribute(made, '__init__', call.place)
        self.beginning.append(made)
        try:
            if isinstance(init, (Bound, Native)):
                self.call(init, call)
            elif is_dataclass(cls):
                self._fill(cls, made, call)
        finally:
            self.beginning.pop()
        self._hand_methods(cls, made, call.place)
        return made

    def _hand_methods(self, cls: Class, made: Instance, place: Place) -> None:
        """Code that is not scanned, of which the class is a part, may call its methods."""
        base = next((c.name for c in cls.mro if isinstance(c, Library) and self._is_open(c)), None)
        if base is None:
            return
        methods = [
            Bound(made, held)
            for each in cls.mro
            if isinstance(each, Class)
            for held in each.slots.values()
            if isinstance(held, Function) and held.binding == 'method'
        ]
        self.note_handed(methods, place, base)

    def _is_open(self, base: Library) -> bool:
        """Whether nothing is known of a class but its name."""
        is_known = is_standard(base.name) and not base.name.startswith(CALLING_BACK)
        return not (is_known or base.name.startswith(self.model.harmless)) and not any(
            self.model.rows(base.name)
        )

    def _made_by_looking(self, cls: Class, place: Place) -> Instance | None:
        """What a property made when it was asked before, as far as this branch knows of it."""
        if not self.world.looking:
            return None
        known = self.world.made_by_looking.get((self.world.looking[-1:], cls, place))
        return known if known is not None and _MADE in known.slots else None

    def _fill(self, cls: Class, instance: Instance, call: Call) -> None:
        """Run the ``__init__`` that a decorator made."""
        fill_fields(self, cls, instance, call)
        post = self.attribute(instance, '__post_init__', call.place)
        if isinstance(post, Bound):
            self.call(post, Call(call.place))
