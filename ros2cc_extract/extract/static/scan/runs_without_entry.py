"""Runs of what no entry reaches: node classes without instances, and functions given a node."""

from __future__ import annotations

import ast
from typing import TypeGuard

from ros2cc_extract.extract.static.concurrency.accesses.signal_locks import signals_of
from ros2cc_extract.extract.static.concurrency.accesses.unreleased_locks import note_kept_locks
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import forget_awaits
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld
from ros2cc_extract.extract.static.program.call_order import (
    callers_first,
    leading_to_entities,
    mentions,
)
from ros2cc_extract.extract.static.program.project import Project
from ros2cc_extract.extract.static.program.relevance import creates_entities
from ros2cc_extract.extract.static.program.relevant_files import names_from_scanned
from ros2cc_extract.extract.static.program.source import SourceFile
from ros2cc_extract.extract.static.program.text_queries import is_test, walk
from ros2cc_extract.extract.static.python.values.unknown_callers import unknown_arguments
from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Class,
    Function,
    Module,
    Value,
    options_of,
)
from ros2cc_extract.extract.static.scan.callback_runs import run_callbacks
from ros2cc_extract.extract.static.scan.guarded_runs import guarded
from ros2cc_extract.extract.static.scan.ros_interpreter import RosInterpreter
from ros2cc_extract.extract.static.scan.runs import UNCALLED, run_rest_of_instances
from ros2cc_extract.extract.static.scan.test_programs import end_test
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import When


def run_library(
    project: Project, source: SourceFile, covered: frozenset[Place]
) -> RosInterpreter | None:
    """
    Follow what no entry reaches in a file: its node classes, and functions given a node.

    :param covered: the class and function statements that were followed already.
    """
    if source.tree is None or not _has_uncovered(project, source, source.tree, covered):
        return None
    machine = _run_library(project, source, covered, frozenset())
    signals = signals_of(machine.world)
    return _run_library(project, source, covered, signals) if signals else machine


def _run_library(
    project: Project, source: SourceFile, covered: frozenset[Place], signals: frozenset[Place]
) -> RosInterpreter:
    """The same, where it is known already where the locks are made that are signals."""
    machine = RosInterpreter(project)
    machine.world.signals = signals
    place = Place(source.shown, 1, 1)
    guarded(machine, lambda: machine.run_module(source, source.module_name) and None, place)
    module = machine.modules[source.shown]
    values = _definitions(machine, module)
    bases = _bases_in_use(values)
    in_text = sorted(values, key=_classes_and_setters_first)
    names, nodes = [v.name for v in in_text], [v.node for v in in_text]
    wanted = leading_to_entities(names, nodes, _makers_elsewhere(module))
    for value in callers_first(in_text, names, nodes):
        if value.place in covered or value.module is not module:
            continue
        if _is_followed(machine, value) or not (value.name in wanted or _inherits(value)):
            continue
        if id(value) in bases:
            continue
        _use_without_caller(machine, value)
        run_callbacks(machine)
        run_rest_of_instances(machine)
        if not machine.steps_left:  # and that was reported
            break
    note_kept_locks(machine.world)
    return machine


def _classes_and_setters_first(value: Class | Function) -> tuple[bool, bool, int]:
    """Functions that set globals come before others, which may need them."""
    sets = any(isinstance(part, ast.Global) for part in walk(value.node))
    return isinstance(value, Function), not sets, value.node.lineno


def _is_followed(machine: RosInterpreter, value: Class | Function) -> bool:
    if isinstance(value, Function):
        return id(value.node) in machine.world.called
    return any(instance.cls is value for instance in machine.world.instances)


def _makers_elsewhere(module: Module) -> frozenset[str]:
    """Functions of other files that make or serve entities."""
    return frozenset(
        name
        for name, value in module.slots.items()
        if isinstance(value, Function)
        and value.module is not module
        and creates_entities(value.node)
    )


def _inherits(value: Class | Function) -> bool:
    """Whether a base class of another file makes or serves entities."""
    return isinstance(value, Class) and any(
        isinstance(base, Class) and base.module is not value.module and creates_entities(base.node)
        for base in value.mro
    )


def _has_uncovered(
    project: Project, source: SourceFile, tree: ast.Module, covered: frozenset[Place]
) -> bool:
    """Whether something that may make entities was not followed, by its text."""
    left = [
        node
        for node in tree.body
        if isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef))
        and Place(source.shown, node.lineno, node.col_offset + 1) not in covered
    ]
    if any(creates_entities(node) for node in left):
        return True
    known = names_from_scanned(project, source, tree) if left else frozenset()
    return any(not known.isdisjoint(mentions(node)) for node in left)


def _definitions(machine: RosInterpreter, module: Module) -> list[Class | Function]:
    """Classes and functions of a module, also those that a decorator or its like hides."""
    found = [
        option
        for value in module.slots.values()
        if isinstance(value, Value)
        for option in options_of(value)
        if isinstance(option, (Class, Function))
    ]
    classes = [cls for cls in machine.world.decorated_classes if cls.module is module]
    hidden: list[Class | Function] = [*dict.fromkeys(classes)]
    hidden += (f for f in machine.world.decorated if f.owner is None and f.module is module)
    hidden += (value for value, _ in machine.world.escaped if _is_of(value, module))
    return [*found, *(f for f in hidden if '<locals>' not in f.qualname and f not in found)]


def _is_of(value: Value, module: Module) -> TypeGuard[Function]:
    """Whether it is a function that stands at the top level of ``module``."""
    return isinstance(value, Function) and value.module is module and value.owner is None


def _bases_in_use(values: list[Class | Function]) -> set[int]:
    """A base class of another class of the file is followed with that one."""
    return {
        id(base)
        for cls in values
        if isinstance(cls, Class) and creates_entities(cls.node)
        for base in cls.mro[1:]
    }


def _use_without_caller(machine: RosInterpreter, value: Class | Function) -> None:
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
        if is_test(value.name):
            end_test(machine)
        nodes, entities = len(machine.world.nodes), len(machine.world.entities)
        since = len(machine.world.diagnostics)
        guarded(machine, lambda: machine.run_function(value, call), value.place)
        if isinstance(value.node, ast.AsyncFunctionDef):
            forget_awaits(machine.world, since)
        _mark_later(machine.world, nodes, entities, value.place)
        if is_test(value.name):
            end_test(machine)


def _mark_later(world: RosWorld, nodes: int, entities: int, place: Place) -> None:
    """What a function adds to a node that was there before is made when it is called."""
    known = {id(node) for node in world.nodes[:nodes]}
    for entity in world.entities[entities:]:
        if id(entity.node) in known and entity.when is When.START:
            entity.when = When.LATER
            entity.path = ((place, UNCALLED), *entity.path)
