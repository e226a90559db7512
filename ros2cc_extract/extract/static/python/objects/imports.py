"""Imports between scanned files; everything else is a library."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.program.project import Project
from ros2cc_extract.extract.static.program.source import SourceFile
from ros2cc_extract.extract.static.program.text_queries import changed_globals
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import (
    Const,
    Instance,
    Module,
    Scope,
    Value,
)
from ros2cc_extract.source_locations import Place


class Imports(Machine):
    """Modules of the scanned program, run at their first import."""

    project: Project
    modules: dict[str, Module]
    _changed: dict[str, frozenset[str]]

    def import_module(self, name: str, place: Place) -> Value:
        """A scanned module, or a library of that name."""
        source = self.project.module(name, place.file)
        if source is None:
            return self.library(name)
        return self.run_module(source, source.module_name)

    def run_module(self, source: SourceFile, run_name: str) -> Module:
        """Run the top level of a file once; an import cycle sees what is there so far."""
        known = self.modules.get(source.shown)
        if known is not None:
            return known
        module = Module(source.module_name, source.shown, source.package)
        self.modules[source.shown] = module
        module.slots['__name__'] = Const(run_name)
        file = self.file_of(source)
        if file is not None:
            module.slots['__file__'] = file
        tree = source.tree
        if tree is not None:
            self.world.trees.append(tree)
            self.world.files.append((tree, source.shown))
            self._run_top_level(tree, module)
        return module

    def file_of(self, source: SourceFile) -> Value | None:
        """What ``__file__`` is in a module; ``None`` where that is known at run time alone."""
        return None

    def _run_top_level(self, tree: ast.Module, module: Module) -> None:
        """Module code runs outside of what the importing code is in the middle of."""
        world = self.world
        saved = (world.path, world.count, world.effects, world.held, world.chain, world.when)
        world.path, world.count, world.effects, world.held, world.chain = (), 1, None, (), ()
        try:
            scope = Scope(module, None)
            scope.slots = module.slots
            with self.store.outside_branches():
                self.execute_block(tree.body, Frame(scope))
        finally:
            world.path, world.count, world.effects, world.held, world.chain, world.when = saved

    def imported(self, module: Value, module_name: str, name: str, place: Place) -> Value:
        """What ``from module import name`` gives."""
        if isinstance(module, Module):
            value = module.slots.get(name)
            if isinstance(value, Value):
                return value
            inner = self.submodule(module, name, place)
            return inner or self.mystery(f'{name!r} is not defined in {module.name}', place, name)
        if self.project.module(f'{module_name}.{name}', place.file) is not None:
            return self.import_module(f'{module_name}.{name}', place)
        return self.attribute(module, name, place)

    def changed_globals(self, module: Module) -> frozenset[str]:
        """Names of globals that some function of the module rebinds or changes in place."""
        known = self._changed.get(module.file)
        if known is None:
            source = self.project.shown_as(module.file)
            tree = source.tree if source else None
            known = changed_globals(tree) if tree else frozenset()
            self._changed[module.file] = known
        return known

    def submodule(self, module: Module, name: str, place: Place) -> Value | None:
        """A module of a scanned package."""
        source = self.project.module(f'{module.name}.{name}', module.file)
        return self.run_module(source, source.module_name) if source else None

    def name_value(self, value: Value, name: str) -> None:
        """Remember the first name under which a group, an executor … is stored."""
        if isinstance(value, Instance) and value.hint is None:
            value.hint = name
