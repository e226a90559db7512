"""Runs of the abstract machine: from an entry, over the callbacks, to what nobody calls."""

from __future__ import annotations

import ast

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.call_order import callers_first, leading_to_entities
from ros2cc_extract.extract.static.entries import Entry
from ros2cc_extract.extract.static.interpreter import Interpreter
from ros2cc_extract.extract.static.machine import BudgetError
from ros2cc_extract.extract.static.project import Project
from ros2cc_extract.extract.static.relevance import creates_entities
from ros2cc_extract.extract.static.source import SourceFile
from ros2cc_extract.extract.static.values import (
    NO_CALLER,
    Bound,
    Call,
    Class,
    Function,
    Instance,
    Module,
    Mystery,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.extract.static.world import Deeds, EntityState, NodeState, World
from ros2cc_extract.places import Place, Unknown
from ros2cc_extract.spec.model import EntityKind, When

_PARAMETERS = {
    EntityKind.SUBSCRIPTION: 1,
    EntityKind.SERVICE: 2,
    EntityKind.ACTION_EXECUTE: 1,
    EntityKind.ACTION_SERVER: 1,
    EntityKind.ACTION_CLIENT: 1,
    EntityKind.DONE_CALLBACK: 1,
}

_CONFIGURING = ('on_configure', 'on_activate', 'on_deactivate', 'on_cleanup', 'on_shutdown')
_CLOSING = ('destroy', 'shutdown', 'cleanup', 'close', 'stop', '__del__', '__exit__', 'on_error')
_CALLBACK_LIMIT = 2_000


def run_entry(project: Project, entry: Entry) -> Interpreter:
    """Follow a program from one of its entries, then its callbacks."""
    machine = Interpreter(project)
    place = Place(entry.source.shown, 1, 1)

    def follow() -> None:
        module = machine.run_module(entry.source, '__main__' if not entry.function else '')
        if entry.function:
            function = module.slots.get(entry.function)
            if isinstance(function, Value):
                result = machine.call(function, Call(place))
                machine.run_if_coroutine(result, place)

    guarded(machine, follow, place)
    _run_escaped(machine)
    run_callbacks(machine)
    run_rest_of_instances(machine)
    return machine


def _run_escaped(machine: Interpreter) -> None:
    """Functions handed to code that is not scanned, such as the loop of another framework."""
    for value, place in machine.world.escaped[:_CALLBACK_LIMIT]:
        inner = value
        while isinstance(inner, Partial):
            inner = inner.function
        function = inner.function if isinstance(inner, Bound) else inner
        if not isinstance(function, Function) or id(function.node) in machine.world.called:
            continue
        if creates_entities(function.node):
            _run_escaped_one(machine, value, function, place)


def _run_escaped_one(machine: Interpreter, value: Value, function: Function, place: Place) -> None:
    def follow() -> None:
        machine.world.path = ((place, -3),)
        machine.world.when = When.LATER
        machine.world.after_spin = False
        skip = 1 if isinstance(value, Bound) else 0
        call = (
            Call(place) if isinstance(value, Partial) else unknown_arguments(function, place, skip)
        )
        machine.run_if_coroutine(machine.call(value, call), place)

    guarded(machine, follow, place)


def run_library(
    project: Project, source: SourceFile, covered: frozenset[int]
) -> Interpreter | None:
    """
    Follow what no entry reaches in a file: its node classes, and functions given a node.

    :param covered: identities of the class and function statements that were followed already.
    """
    if source.tree is None or not _has_uncovered(source.tree, covered):
        return None
    machine = Interpreter(project)
    place = Place(source.shown, 1, 1)
    guarded(machine, lambda: machine.run_module(source, source.module_name) and None, place)
    module = machine.modules[source.shown]
    values = _definitions(machine, module)
    bases = _bases_in_use(values)
    in_text = sorted(values, key=_classes_and_setters_first)
    names, nodes = [v.name for v in in_text], [v.node for v in in_text]
    wanted = leading_to_entities(names, nodes, frozenset())
    for value in callers_first(in_text, names, nodes):
        if id(value.node) in covered or value.module is not module:
            continue
        if _is_followed(machine, value) or value.name not in wanted:
            continue
        if id(value) in bases:
            continue
        _use_without_caller(machine, value)
        run_callbacks(machine)
        run_rest_of_instances(machine)
    return machine


def _classes_and_setters_first(value: Class | Function) -> tuple[bool, bool, int]:
    """Functions that set globals come before others, which may need them."""
    sets = any(isinstance(part, ast.Global) for part in ast.walk(value.node))
    return isinstance(value, Function), not sets, value.node.lineno


def _is_followed(machine: Interpreter, value: Class | Function) -> bool:
    if isinstance(value, Function):
        return id(value.node) in machine.world.called
    return any(instance.cls is value for instance in machine.world.instances)


def _has_uncovered(tree: ast.Module, covered: frozenset[int]) -> bool:
    return any(
        id(node) not in covered and creates_entities(node)
        for node in tree.body
        if isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef))
    )


def _definitions(machine: Interpreter, module: Module) -> list[Class | Function]:
    """Classes and functions of a module, also those that a decorator hides."""
    found = [
        option
        for value in module.slots.values()
        if isinstance(value, Value)
        for option in options_of(value)
        if isinstance(option, (Class, Function))
    ]
    hidden = [f for f in machine.world.decorated if f.owner is None and f.module is module]
    return [*found, *(f for f in hidden if '<locals>' not in f.qualname and f not in found)]


def _bases_in_use(values: list[Class | Function]) -> set[int]:
    """A base class of another class of the file is followed with that one."""
    return {
        id(base)
        for cls in values
        if isinstance(cls, Class) and creates_entities(cls.node)
        for base in cls.mro[1:]
    }


def _use_without_caller(machine: Interpreter, value: Class | Function) -> None:
    machine.world.after_spin = False
    if isinstance(value, Class):
        init = next(
            (
                c.slots['__init__']
                for c in value.mro
                if isinstance(c, Class) and '__init__' in c.slots
            ),
            None,
        )
        call = Call(value.place)
        if isinstance(init, Function):
            call = unknown_arguments(init, value.place, skip=1)
        guarded(machine, lambda: machine.instantiate(value, call), value.place)
    else:
        call = unknown_arguments(value, value.place, skip=0)
        guarded(machine, lambda: machine.run_function(value, call), value.place)


def unknown_arguments(function: Function, place: Place, skip: int) -> Call:
    """A call of ``function`` by somebody who is not in sight."""
    arguments = function.node.args
    names = [parameter.arg for parameter in (*arguments.posonlyargs, *arguments.args)]
    defaults = dict(
        zip(names[len(names) - len(function.defaults) :], function.defaults, strict=False)
    )
    defaults.update(function.keyword_defaults)
    call = Call(place)
    for name in names[skip:]:
        call.args.append(_unknown_argument(function, name, defaults.get(name)))
    for parameter in arguments.kwonlyargs:
        name = parameter.arg
        call.keywords[name] = _unknown_argument(function, name, defaults.get(name))
    if arguments.vararg or arguments.kwarg:
        reason = f'further arguments of {function.qualname}; {NO_CALLER}'
        call.more = Unknown(reason, function.place)
    return call


def _unknown_argument(function: Function, name: str, default: Value | None) -> Mystery:
    reason = f'parameter {name!r} of {function.qualname}; {NO_CALLER}'
    return Mystery(Unknown(reason, function.place), name, default)


def guarded(machine: Interpreter, act: object, place: Place) -> None:
    """Do ``act``; a program too large to be followed ends in a diagnostic."""
    world = machine.world
    machine.steps = 0
    try:
        act()  # type: ignore[operator]
    except BudgetError:
        _complain(world, place, 'set-up is too long to be followed to its end')
    except RecursionError:
        _complain(world, place, 'set-up is nested too deeply to be followed')
    finally:
        machine.stack.clear()
        machine.depth = 0
        world.path, world.count, world.chain, world.held = (), 1, (), ()
        world.stopped, world.deeds, world.current, world.looking = False, None, None, ()
        world.in_thread, world.when = False, When.START
        machine.store.reset()


def _complain(world: World, place: Place, message: str) -> None:
    world.diagnostics.append(
        Diagnostic(
            severity=Severity.WARNING,
            slug='not-followed',
            place=place,
            message=message,
            help='what it would make is missing from the units',
        )
    )
    world.cut.append((message, place))


def run_callbacks(machine: Interpreter) -> None:
    """Follow every callback once, also of entities that callbacks make."""
    entities = machine.world.entities
    index = machine.world.followed
    while index < min(len(entities), _CALLBACK_LIMIT):
        entity = entities[index]
        index += 1
        machine.world.followed = index
        entity.deeds = Deeds()
        for callback in (entity.callback, *entity.extra_callbacks):
            if callback is not None:
                _run_callback(machine, entity, callback, entity.deeds)


def _run_callback(
    machine: Interpreter, entity: EntityState, callback: Value, deeds: Deeds
) -> None:
    def follow() -> None:
        world = machine.world
        world.deeds, world.current, world.when = deeds, entity, When.CALLBACK
        world.count = Unknown('made each time the callback runs', entity.place)
        world.path = world.callback_path = ((entity.place, -2),)
        world.after_spin = False
        mark = machine.store.open_branch()
        call = Call(entity.place, _callback_arguments(entity))
        for option in options_of(callback):
            result = machine.call(option, call)
            machine.run_if_coroutine(result, entity.place)
        writes = machine.store.close_branch(mark)
        machine.store.join([writes, {}])

    guarded(machine, follow, entity.place)


def _callback_arguments(entity: EntityState) -> list[Value]:
    if entity.argument is not None:
        return [entity.argument]
    return [
        Mystery(Unknown('argument of a callback', entity.place), '')
        for _ in range(_PARAMETERS.get(entity.kind, 0))
    ]


def run_rest_of_instances(machine: Interpreter) -> None:
    """Methods that make entities and that nobody in sight calls; they may be called later."""
    seen = 0
    while seen < min(len(machine.world.instances), _CALLBACK_LIMIT):
        instance = machine.world.instances[seen]
        seen += 1
        for name, method in _methods_without_caller(machine, instance):
            if id(method.node) not in machine.world.called:
                _run_later(machine, instance, name, method)
                run_callbacks(machine)


def _methods_without_caller(
    machine: Interpreter, instance: Instance
) -> list[tuple[str, Function]]:
    """
    Methods not followed yet that lead to entities, callers before what they call.

    Using a scanned class or function that makes some leads to entities too.
    """
    left = [
        (name, method)
        for name, method in _methods_of(machine, instance)
        if id(method.node) not in machine.world.called
    ]
    modules = {id(method.module): method.module for _, method in left}
    makers = frozenset(
        name
        for module in modules.values()
        for name, value in module.slots.items()
        if isinstance(value, (Class, Function))
        and value not in instance.mro
        and creates_entities(value.node)
    )
    names, nodes = [method.name for _, method in left], [method.node for _, method in left]
    wanted = leading_to_entities(names, nodes, makers)
    ordered = callers_first(left, names, nodes)
    return [(name, method) for name, method in ordered if method.name in wanted]


def _methods_of(machine: Interpreter, instance: Instance) -> list[tuple[str, Function]]:
    found: dict[str, Function] = {}
    for function in machine.world.decorated:
        if function.owner is not None and function.owner in instance.mro:
            found.setdefault(function.name, function)
    for cls in instance.mro:
        if isinstance(cls, Class):
            for name, value in cls.slots.items():
                if isinstance(value, Function) and name not in found:
                    found[name] = value
    lifecycle = isinstance(instance.state, NodeState) and instance.state.lifecycle
    first = _CONFIGURING if lifecycle else ()
    return sorted(found.items(), key=lambda item: (item[0] not in first, item[1].node.lineno))


def _run_later(machine: Interpreter, instance: Instance, name: str, method: Function) -> None:
    lifecycle = isinstance(instance.state, NodeState) and instance.state.lifecycle
    place = method.place

    def follow() -> None:
        world = machine.world
        world.when = When.CONFIGURE if lifecycle and name in _CONFIGURING else When.LATER
        world.shutting_down = any(word in name for word in _CLOSING)
        world.after_spin = False
        if world.when is When.LATER:
            world.path = ((place, -3),)
        static = method.binding == 'static'
        call = unknown_arguments(method, place, skip=0 if static else 1)
        target: Value = method if static else Bound(instance, method)
        result = machine.call(target, call)
        machine.run_if_coroutine(result, place)
        world.shutting_down = False

    guarded(machine, follow, place)
    machine.world.called.add(id(method.node))
