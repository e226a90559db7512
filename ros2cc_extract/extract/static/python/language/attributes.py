"""Looking attributes up: instances, classes, modules, libraries, constants."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.python.branching import open_tests
from ros2cc_extract.extract.static.python.builtins import (
    absent_attributes,
    builtin_methods,
    computed_names,
    dispatching,
    generators,
    given_functions,
)
from ros2cc_extract.extract.static.python.builtins.code_behind import setters_behind
from ros2cc_extract.extract.static.python.machine.machine import ENTRIES, Machine
from ros2cc_extract.extract.static.python.machine.world import Cut, note_once
from ros2cc_extract.extract.static.python.objects import subclass_registry
from ros2cc_extract.extract.static.python.objects.metaclasses import NEW, of_metaclass, type_call
from ros2cc_extract.extract.static.python.objects.unset_globals import UNSET
from ros2cc_extract.extract.static.python.values.containers import (
    Fields,
    Generator,
    Mapping,
    Sequence,
)
from ros2cc_extract.extract.static.python.values.enumerations import Member
from ros2cc_extract.extract.static.python.values.partial_methods import PartialMethod
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Choice,
    Class,
    Const,
    Function,
    Instance,
    Library,
    Module,
    Mystery,
    Native,
    Partial,
    Super,
    Value,
    choice,
    present,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import When


def _owner_text(text: str | ast.expr) -> str | ast.expr:
    """What stands before the dot."""
    return text.value if isinstance(text, ast.Attribute) else text


def _defines(cls: Value, name: str) -> bool:
    return isinstance(cls, Class) and name in cls.slots


_GETTER, _ANY = '__getattribute__', '(any)'


class Attributes(Machine):
    """What stands behind a dot."""

    def attribute(self, value: Value, name: str, place: Place, text: str | ast.expr = '') -> Value:
        """``value.name``."""
        found = self._find(value, name, place, text)
        if isinstance(found, Choice):
            return present(found)
        if found is not None:
            return found
        if isinstance(value, Mystery):
            label = text or (f'{value.text}.{name}' if value.text else name)
            return Mystery(value.unknown, label)
        reason = f'attribute {name!r} could not be followed'
        if name.startswith(self.model.making):
            note_once(self.world.cut, Cut(reason, place, self.running_classes()))
        if isinstance(value, Instance) and self.world.in_callback:
            self.world.lacking.append((value, name))
        return self.mystery(reason, place, text or name)

    def has_attribute(self, value: Value, name: str) -> bool | None:
        """Whether ``value.name`` exists; ``None`` when that depends."""
        if isinstance(value, (Mystery, Choice)):
            return None
        found = self._find(value, name, Place(''))
        if found is not None:
            return True
        is_later = self.world.when is not When.START or self.world.effects is not None
        is_open = isinstance(value, Instance) and any(not isinstance(c, Class) for c in value.mro)
        if is_open or (is_later and isinstance(value, Instance)):
            return False if absent_attributes.is_absent(self, value, name) else None
        return False

    def special_method(self, owner: Value, name: str, place: Place) -> Bound | None:
        """A method of a scanned class that Python calls for a statement or built-in function."""
        if not isinstance(owner, Instance) or not any(_defines(cls, name) for cls in owner.mro):
            return None
        method = self._in_order(owner.mro, owner, name, place)
        return method if isinstance(method, Bound) else None

    def _find(
        self, value: Value, name: str, place: Place, text: str | ast.expr = ''
    ) -> Value | None:
        if isinstance(value, Instance):
            return self._of_instance(value, name, place)
        if isinstance(value, Class):
            return self._of_class(value, name, place)
        if isinstance(value, Module):
            return self._of_module(value, name, place)
        if isinstance(value, Library):
            if name == '__new__':
                return NEW
            if (value.name, name) == ('builtins.object', '__setattr__'):
                return Native(name, builtin_methods.set_attribute_of, NONE)
            if (value.name, name) == ('builtins.object', _GETTER):
                return Native(name, builtin_methods.attribute_of, NONE)
            member = self.library_member(value, None, name, place)
            return member or self.library(f'{value.name}.{name}')
        if isinstance(value, Super):
            return self._of_super(value, name, place)
        if value == NONE:
            unset = Mystery(Unknown(UNSET, place), _owner_text(text))
            return self.member_of_mystery(unset, name, place)
        if isinstance(value, Const) and isinstance(value.value, Member):
            method = value.value.method(name)
            if method is not None:
                return self._of_member(value, value.value, method, place)
            return value.value.attribute(name, place)
        if isinstance(value, Fields):
            return builtin_methods.field_method(value, name)
        if isinstance(value, Generator):
            return generators.method(name, value)
        if isinstance(value, (Sequence, Mapping, Const)):
            return builtin_methods.method(value, name)
        if isinstance(value, Mystery):
            return self.member_of_mystery(value, name, place)
        return self._of_callable(value, name)

    def _of_instance(self, value: Instance, name: str, place: Place) -> Value | None:
        if self.world.intercepts:
            given = self._intercepted(value, name, place)
            if given is not None:
                return given
        if name in self.world.described and setters_behind(self, value, name):
            return self._in_order(value.mro, value, name, place)
        if name in value.slots and isinstance(value.slots[name], Value):
            return self.attribute_as_of_now(value, name, value.slots[name], place)
        if name == '__class__':
            return value.cls
        if name == '__dict__':
            return Fields(value)
        if name == '__setattr__' and not any(_defines(cls, name) for cls in value.mro):
            return Native(name, builtin_methods.set_attribute, value)
        found = self._in_order(value.mro, value, name, place)
        if isinstance(found, Const):
            return self.attribute_as_of_now(value, name, found, place)
        if not isinstance(found, (Bound, Native)):
            open_tests.note_attribute(self, value, name, found)
        found = found or self._handed_on(value, name, place)
        if found is None or isinstance(found, Mystery):
            computed = computed_names.held(self, value, name)
            rest = [found] if found is not None else []
            return choice([*computed, *rest]) if computed else found
        return found

    def _handed_on(self, owner: Instance, name: str, place: Place) -> Value | None:
        """What ``__getattr__`` of a scanned class gives for an attribute it lacks."""
        if name.startswith('__'):
            return None
        getter = self._in_order(owner.mro, owner, '__getattr__', place)
        if not isinstance(getter, Bound):
            return None
        return self._called_by_looking(owner, name, getter, Call(place, [Const(name)]))

    def _intercepted(self, owner: Instance, name: str, place: Place) -> Value | None:
        """What an own ``__getattribute__`` gives, unless that looks further as Python does."""
        if name.startswith('__') or (id(owner), _ANY) in self.world.looking:
            return None
        if not any(_defines(cls, _GETTER) for cls in owner.mro):
            return None
        getter = self._in_order(owner.mro, owner, _GETTER, place)
        if not isinstance(getter, Bound):
            return None
        given = self._called_by_looking(owner, _ANY, getter, Call(place, [Const(name)]))
        return None if isinstance(given, Mystery) else given

    def _called_by_looking(self, owner: Instance, name: str, getter: Bound, call: Call) -> Value:
        """The result of code behind an attribute; what it makes, it makes once for ``owner``."""
        before = self.world.looking
        self.world.looking = (*before, (id(owner), name))
        try:
            return self.call(getter, call)
        finally:
            self.world.looking = before

    def attribute_as_of_now(self, owner: Instance, name: str, held: Value, place: Place) -> Value:
        """
        What an attribute holds once the set-up is over.

        A plain constant that other methods assign anew may be anything by then, unless all of
        them store the same again.
        """
        open_tests.note_attribute(self, owner, name, held)
        if self.world.when is When.START or not isinstance(held, Const):
            return held
        if open_tests.assigns_other(self.world, owner, name, held):
            self.world.unset += held == NONE
            changed = Unknown(f'attribute {name!r} is assigned anew by other methods', place)
            known = open_tests.ever_held(self, owner, name) if held == NONE else None
            return choice([held, *(known or [Mystery(changed, f'self.{name}')])])
        return held

    def _in_order(
        self, order: tuple[Value, ...], receiver: Value, name: str, place: Place
    ) -> Value | None:
        for number, cls in enumerate(order, start=1):
            if not number % ENTRIES:
                self.charge(1)
            if isinstance(cls, Class):
                if name in cls.slots:
                    return self._bind(cls.slots[name], receiver, place)
            elif isinstance(cls, Library):
                native = self.library_member(cls, receiver, name, place)
                if native is not None:
                    return native
        return self.member_of_unknown_base(order, receiver, name, place)

    def _bind(self, member: Value, receiver: Value, place: Place) -> Value:
        if isinstance(member, Instance) and member.cls is not receiver:
            return self._described(member, receiver, place)
        if isinstance(member, PartialMethod) and isinstance(receiver, Instance):
            bound = self._bind(member.function, receiver, place)
            return Partial(bound, member.args, member.keywords, member.more)
        if isinstance(member, Native) and member.name == dispatching.METHOD:
            return Partial(member, (receiver,), {}) if isinstance(receiver, Instance) else member
        if not isinstance(member, Function):
            return member
        if member.binding == 'static':
            return member
        if member.binding == 'class':
            cls = receiver.cls if isinstance(receiver, Instance) else receiver
            return Bound(cls, member)
        if not isinstance(receiver, Instance):
            return member
        if member.binding == 'property':
            getter = Bound(receiver, member)
            return self._called_by_looking(receiver, member.name, getter, Call(place))
        return Bound(receiver, member)

    def _of_member(self, value: Const, member: Member, method: Function, place: Place) -> Value:
        if method.binding == 'property':
            return self.call(Bound(value, method), Call(place))
        if method.binding == 'static':
            return method
        return Bound(member.cls if method.binding == 'class' else value, method)

    def _described(self, member: Instance, receiver: Value, place: Place) -> Value:
        """An object of the class: where it has ``__get__``, what that gives."""
        getter = self.special_method(member, '__get__', place)
        if getter is None:
            return member
        if not isinstance(receiver, Instance):
            return self.call(getter, Call(place, [NONE, receiver]))
        call = Call(place, [receiver, receiver.cls])
        return self._called_by_looking(receiver, member.hint or '', getter, call)

    def _of_class(self, value: Class, name: str, place: Place) -> Value | None:
        if name in ('__name__', '__qualname__'):
            return Const(value.name)
        if name == '__subclasses__':
            return Native(name, subclass_registry.subclasses_of, value)
        for cls in value.mro:
            if isinstance(cls, Class) and name in cls.slots:
                return self._bind(cls.slots[name], value, place)
            if isinstance(cls, Library):
                found = self.library_member(cls, None, name, place)
                if found is not None:
                    return found
        return NEW if name == '__new__' else of_metaclass(value, name)

    def _of_module(self, value: Module, name: str, place: Place) -> Value | None:
        if name in value.slots:
            found: Value = value.slots[name]
            open_tests.note_global(self, value, name, found)
            return found
        if name == '__name__':
            return Const(value.name)
        if name == '__file__':
            return Mystery(Unknown('path of the file at run time', place), '__file__')
        return self.submodule(value, name, place)

    def _of_super(self, value: Super, name: str, place: Place) -> Value | None:
        receiver = value.receiver
        order = receiver.mro if isinstance(receiver, (Instance, Class)) else value.owner.mro
        if isinstance(receiver, Class) and value.owner not in order:
            found = of_metaclass(receiver, name, behind=value.owner)
            return found or (type_call(receiver) if name == '__call__' else None)
        behind = order[order.index(value.owner) + 1 :] if value.owner in order else ()
        if name == '__new__' and not any(_defines(cls, name) for cls in behind):
            return NEW
        if name == '__setattr__' and not any(_defines(cls, name) for cls in behind):
            return Native(name, builtin_methods.set_attribute, receiver)
        if name == _GETTER and not any(_defines(cls, name) for cls in behind):
            return Native(name, builtin_methods.attribute_of, receiver)
        return self._in_order(behind, receiver, name, place)

    def _of_callable(self, value: Value, name: str) -> Value | None:
        if name in ('__name__', '__qualname__') and isinstance(value, (Function, Bound)):
            function = value if isinstance(value, Function) else value.function
            return Const(function.name)
        if name == '__self__' and isinstance(value, Bound):
            return value.receiver
        if name == '__func__' and isinstance(value, Bound):
            return value.function
        if name == 'func' and isinstance(value, Partial):
            return value.function
        held = value.function if isinstance(value, Bound) else value
        if isinstance(held, Function) and name in held.slots:
            found: Value = held.slots[name]
            return found
        if isinstance(value, Function) and name == '__get__':
            return Native(name, given_functions.method_of, value)
        if isinstance(value, Native) and value.name == 'builtins.type' and name == '__call__':
            return type_call(NONE)
        if isinstance(value, Native) and name == '__name__':
            return Const(value.name)
        return dispatching.member(value, name) if isinstance(value, Native) else None
