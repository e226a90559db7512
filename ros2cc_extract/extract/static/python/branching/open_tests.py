"""
What a test in a callback reads may have changed since the set-up.

Callbacks are followed one after the other from the state that the set-up leaves behind, but run
in any order: a test on what some other function changes is open, no matter what is stored now.
So it is in the set-up itself once anything has been spun.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence as Several

from ros2cc_extract.extract.static.program.text_queries import (
    assignments_of_attributes,
    noted_on,
    reassigned_attributes,
    walk,
)
from ros2cc_extract.extract.static.python.builtins import code_behind
from ros2cc_extract.extract.static.python.machine.dependences import Asked, computed_from, names_in
from ros2cc_extract.extract.static.python.machine.fixed_point import note_met
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.objects import loops
from ros2cc_extract.extract.static.python.values.containers import Collection, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Class,
    Const,
    Function,
    Instance,
    Module,
    Partial,
    Scope,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import When


def decide(machine: Machine, test: ast.expr, frame: Frame) -> bool | None:
    """``bool(test)``; ``None`` when that depends, also on when it is asked."""
    before = machine.world.changing
    machine.world.reading.note_asked(test, frame.module.file)
    value = machine.evaluate(test, frame)
    code_behind.asked_as(machine, value, 'bool', frame.place(test))
    holds = machine.truth(value)
    machine.world.tested = value
    return holds if machine.world.changing == before else None


def decide_branch(machine: Machine, node: ast.If, frame: Frame, outer: ast.If) -> bool | None:
    """As ``decide``, for the arms of ``outer``: what they do rests on what is read here."""
    if machine.world.effects is None:
        return decide(machine, node.test, frame)
    place, found = frame.place(outer), set[str]()
    holds = _decide_tested(machine, node, place, found, frame, is_first=node is outer)
    machine.note_branch(node, found, place, frame, is_first=node is outer)
    return holds


def decide_expression(machine: Machine, node: ast.IfExp, frame: Frame) -> bool | None:
    """The same for ``a if test else b``."""
    if machine.world.effects is None:
        return decide(machine, node.test, frame)
    return _decide_tested(machine, node, frame.place(node), set(), frame, is_first=True)


def evaluate_subject(machine: Machine, node: ast.Match, frame: Frame) -> None:
    """What a ``match`` asks for: which of its cases holds rests on what is read here."""
    reading, place, found = machine.world.reading, frame.place(node), set[str]()
    calls = reading.calls
    with reading.of(found):
        machine.evaluate(node.subject, frame)
    reading.tests[place] = frozenset(found) | computed_from(node.subject, frame.sources)
    note_tested(machine, place, calls)


def decide_assertion(machine: Machine, node: ast.Assert, frame: Frame) -> None:
    """What follows an ``assert`` rests on what is read for it, as behind an ``if`` that raises."""
    reading, place, found = machine.world.reading, frame.place(node), set[str]()
    calls = reading.calls
    with reading.of(found):
        decide(machine, node.test, frame)
    reading.tests[place] = frozenset(found) | computed_from(node.test, frame.sources)
    note_tested(machine, place, calls)


def _decide_tested(
    machine: Machine,
    node: ast.If | ast.IfExp,
    place: Place,
    found: set[str],
    frame: Frame,
    *,
    is_first: bool,
) -> bool | None:
    """What follows at ``place`` rests on what is read for the test, which ``found`` gets."""
    reading = machine.world.reading
    calls = reading.calls
    with reading.of(found):
        holds = decide(machine, node.test, frame)
    known = frozenset() if is_first else reading.tests.get(place, frozenset())
    reading.tests[place] = known | found | computed_from(node.test, frame.sources)
    if is_first:
        note_tested(machine, place, calls)
    return holds


def note_tested(machine: Machine, place: Place, calls: int) -> None:
    """Note what had happened before a test."""
    reading, effects = machine.world.reading, machine.world.effects
    reading.tested_at[place] = calls
    begun = effects.begun if effects is not None else 0
    reading.begun_at[place] = begun, begun - len(machine.stack)


def decide_loop(machine: Machine, node: ast.While, frame: Frame) -> tuple[bool | None, Asked]:
    """As ``decide``, for a loop: what it does in its rounds rests on what is read here."""
    found = set[str]()
    with machine.world.reading.of(found):
        holds = decide(machine, node.test, frame)
    names = frozenset(found) | computed_from(node.test, frame.sources)
    return holds, machine.asked_by_loop(node, names, frame.place(node))


def note_rounds(loop: ast.While, frame: Frame) -> None:
    """In a later round, names that the loop rebinds hold what the round before has left."""
    frame.copies = frame.copies | noted_on(loop, 'rebound', _rebound)


def _rebound(loop: ast.AST) -> frozenset[str]:
    return frozenset(
        part.id
        for part in walk(loop)
        if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store)
    )


def evaluate_copied(
    machine: Machine, value: ast.expr, targets: Several[ast.expr], frame: Frame
) -> Value:
    """The value of an assignment; a name that gets it is as open as what was read for it."""
    before = machine.world.changing
    held = _evaluate_for(machine, value, targets, frame)
    is_open = machine.world.changing != before
    if is_open or frame.copies:
        names = {target.id for target in targets if isinstance(target, ast.Name)}
        frame.copies = frame.copies | names if is_open else frame.copies - names
    return held


def _evaluate_for(
    machine: Machine, value: ast.expr, targets: Several[ast.expr], frame: Frame
) -> Value:
    if machine.world.effects is None:
        return machine.evaluate(value, frame)
    reading, found = machine.world.reading, set[str]()
    with reading.of(found):
        held = machine.evaluate(value, frame)
    flowing = frozenset(found) | computed_from(value, frame.sources)
    frame.sources.update(
        (target.id, flowing) for target in targets if isinstance(target, ast.Name)
    )
    reading.flowing = flowing
    return held


def evaluate_argument(
    machine: Machine, argument: ast.expr, frame: Frame, call: Call, at: int | str | None
) -> Value:
    """The value of an argument; a parameter knows what it was computed from, as a name does."""
    if machine.world.effects is None or isinstance(argument, ast.Constant):
        return machine.evaluate(argument, frame)
    found = set[str]()
    with machine.world.reading.of(found):
        held = machine.evaluate(argument, frame)
    sources = frozenset(found) | computed_from(argument, frame.sources)
    if at is not None and sources:
        call.sources[at] = sources
    return held


def evaluate_iterated(machine: Machine, node: ast.For | ast.AsyncFor, frame: Frame) -> Value:
    """What a loop goes over; the names of its rounds are computed from what was read for it."""
    if machine.world.effects is None:
        return machine.evaluate(node.iter, frame)
    found = set[str]()
    with machine.world.reading.of(found):
        values = machine.evaluate(node.iter, frame)
    sources = frozenset(found) | computed_from(node.iter, frame.sources)
    frame.sources.update(dict.fromkeys(names_in(node.target), sources))
    return values


def asked_by_rounds(node: ast.For | ast.AsyncFor, frame: Frame) -> Asked:
    """``for _ in range(q.qsize())``: as many rounds as there were items."""
    call = node.iter
    is_count = isinstance(call, ast.Call) and ast.unparse(call.func) == 'range'
    names = [frame.sources.get(name, frozenset()) for name in names_in(node.target)]
    found = frozenset[str]().union(*names) if is_count else frozenset[str]()
    return Asked(found, frozenset(), is_open=False)


def _others_have_run(world: World) -> bool:
    """Whether callbacks may have run since the set-up has stored something: it has spun, too."""
    return world.when is When.CALLBACK or (world.when is When.START and world.has_let_others_run)


def note_attribute(machine: Machine, owner: Instance, name: str, held: Value | None) -> None:
    """``owner.name`` is read and gives ``held``."""
    if not _others_have_run(machine.world) or (owner, name) in machine.world.settled_now:
        return
    if isinstance(held, Collection) and _may_be_filled(machine, held):
        machine.world.changing += 1
        if not holds_objects(held) and machine.world.when is When.CALLBACK:
            machine.world.lacking.append((held, None))
    elif is_assigned_later(machine, owner, name, held):
        machine.world.changing += 1
        note_met(machine.world, owner, name, held)


def assigns_other(world: World, owner: Instance, name: str, held: Value | None) -> bool:
    """
    Whether a method of ``owner`` assigns anything but the constant that it holds already.

    That it holds since before anything else was at work.
    """
    if (owner, name) in world.settled_now:
        return False
    constant = held if isinstance(held, Const) and held != NONE else None  # set elsewhere
    if (owner, name) in world.stored_late:
        constant = None
    for cls in owner.mro:
        if isinstance(cls, Class):
            texts = reassigned_attributes(cls.node).get(name)
            if texts and not (constant and all(_is_written_as(constant, each) for each in texts)):
                return True
    return False


def _is_written_as(held: Const, text: ast.expr | None) -> bool:
    """Whether a text is a literal of the constant."""
    is_literal = isinstance(text, ast.Constant) and type(text.value) is type(held.value)
    return is_literal and text.value == held.value  # type: ignore[union-attr]


def is_assigned_later(
    machine: Machine, owner: Instance, name: str, held: Value | None = None
) -> bool:
    """
    Whether a method of ``owner`` or code outside of its class assigns the attribute anew.

    :param held: what it holds; a constant that is assigned again stays what it is.
    """
    own = assigns_other(machine.world, owner, name, held)
    return own or any(name in _handed_in(tree) for tree in machine.world.trees)


def ever_held(machine: Machine, owner: Instance, name: str) -> list[Value] | None:
    """The objects that the attribute ever holds, if every assignment was followed."""
    stored = machine.world.stored.get((owner, name), {})
    options = [option for value in stored.values() for option in options_of(value)]
    values = [option for option in options if option != NONE]
    if not values or not all(isinstance(value, Instance) for value in values):
        return None
    sites = [
        Place(cls.module.file, line, column)
        for cls in owner.mro
        if isinstance(cls, Class)
        for line, column in assignments_of_attributes(cls.node).get(name, ())
    ]
    if any(site not in stored for site in sites):
        return None
    return None if any(name in _handed_in(tree) for tree in machine.world.trees) else values


def note_global(machine: Machine, module: Module, name: str, held: Value) -> None:
    """``module.name`` is read and gives ``held``."""
    if not _others_have_run(machine.world):
        return
    if _may_be_filled(machine, held):
        machine.world.changing += 1
    elif name in machine.changed_globals(module):
        machine.world.changing += 1
        note_met(machine.world, module, name, held)


def note_name(machine: Machine, name: str, held: Value, frame: Frame) -> None:
    """A name is read and gives ``held``."""
    if not _others_have_run(machine.world):
        return
    if name in frame.scope.slots:
        is_open = name in frame.copies
        if machine.world.when is When.START:
            is_open = is_open or _may_be_filled(machine, held)
            is_open = is_open or _is_rebound_inside(machine, name, frame)
        machine.world.changing += is_open
        return
    if _may_be_filled(machine, held):
        machine.world.changing += 1
    elif _is_rebound(machine, name, frame):
        machine.world.changing += 1
        note_met(machine.world, _owner_of(name, frame), name, held)


def _is_rebound_inside(machine: Machine, name: str, frame: Frame) -> bool:
    """Whether a function inside of what is followed may rebind its ``name``."""
    if frame.function is None:
        return name in machine.changed_globals(frame.module)
    return name in noted_on(frame.function.node, 'nonlocals', _nonlocal_names)


def _owner_of(name: str, frame: Frame) -> Scope | Module:
    scope = frame.scope.parent
    while scope is not None and name not in scope.slots:
        scope = scope.parent
    return scope or frame.module


def _is_rebound(machine: Machine, name: str, frame: Frame) -> bool:
    scope = frame.scope.parent
    while scope is not None:
        if name in scope.slots:
            return any(name in _nonlocals(tree) for tree in machine.world.trees)
        scope = scope.parent
    return name in machine.changed_globals(frame.module)


def _may_be_filled(machine: Machine, held: Value | None) -> bool:
    if not isinstance(held, Collection):
        return False
    if machine.world.when is When.START:
        is_fixed = isinstance(held, Sequence) and held.kind in ('tuple', 'range')
        return not is_fixed and not held.slots.get('items') and not held.slots.get('entries')
    return loops.may_be_filled(machine, held)


def holds_objects(collection: Collection) -> bool:
    """Whether it has objects that a callback may take."""
    items = (
        *collection.slots.get('items', ()),
        *collection.slots.get('entries', {}).values(),
    )
    return any(isinstance(option, _THINGS) for item in items for option in options_of(item))


_THINGS = (Instance, Bound, Function, Partial)


def _handed_in(tree: ast.Module) -> frozenset[str]:
    return noted_on(tree, 'handed_in', _attributes_of_others)


def _attributes_of_others(tree: ast.Module) -> frozenset[str]:
    """Attributes that functions assign on something else than ``self``."""
    return frozenset(
        part.attr
        for part in walk(tree)
        if isinstance(part, ast.Attribute)
        and isinstance(part.ctx, ast.Store)
        and not (isinstance(part.value, ast.Name) and part.value.id == 'self')
    )


def _nonlocals(tree: ast.Module) -> frozenset[str]:
    return noted_on(tree, 'nonlocals', _nonlocal_names)


def _nonlocal_names(tree: ast.AST) -> frozenset[str]:
    return frozenset(
        name for part in walk(tree) if isinstance(part, ast.Nonlocal) for name in part.names
    )
