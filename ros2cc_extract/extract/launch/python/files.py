"""Python launch files: followed by the abstract interpreter, never run or imported."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from pathlib import Path

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.launch.language.actions import Action, Unfollowed
from ros2cc_extract.extract.launch.language.context import Context
from ros2cc_extract.extract.launch.language.evaluation import Evaluator
from ros2cc_extract.extract.launch.python import paths
from ros2cc_extract.extract.launch.python.actions import Actions
from ros2cc_extract.extract.launch.python.table import CONTEXT, PREFIX, launch_model
from ros2cc_extract.extract.launch.python.values import Values
from ros2cc_extract.extract.launch.workspace.packages import Packages
from ros2cc_extract.extract.static.program.project import Project
from ros2cc_extract.extract.static.program.runtime_limits import scanning_limits
from ros2cc_extract.extract.static.program.source import SourceFile
from ros2cc_extract.extract.static.python.interpreter import Interpreter
from ros2cc_extract.extract.static.python.machine.frame import BudgetError
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.values.containers import Mapping
from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Const,
    Function,
    Instance,
    Library,
    Module,
    Mystery,
    Value,
)
from ros2cc_extract.files import Files
from ros2cc_extract.source_locations import Place, Unknown

_START = 'generate_launch_description'
_LIBRARIES = ('launch', 'launch_ros', 'launch_xml', 'launch_yaml')
# Of one piece, and of all files of a launch with all that their functions give.
_STEPS, _STEPS_IN_ALL = 200_000, 800_000


class _LaunchInterpreter(Interpreter):
    """Knows where each module stands."""

    def file_of(self, source: SourceFile) -> Value | None:
        """What ``__file__`` is in a module."""
        return Const(str(source.path))

    def library_operation(self, op: ast.operator, left: Value, right: Value) -> Value | None:
        """``path / name``."""
        return paths.joined([left, right]) if isinstance(op, ast.Div) else None

    def attribute(self, value: Value, name: str, place: Place, text: str | ast.expr = '') -> Value:
        """``path.parent`` and the like."""
        return paths.member(value, name) or super().attribute(value, name, place, text)

    def import_module(self, name: str, place: Place) -> Value:
        """The folder of launch files is often called ``launch``; that is never the package."""
        if name.partition('.')[0] in _LIBRARIES:
            return self.library(name)
        return super().import_module(name, place)


class PythonFile:
    """
    One Python launch file.

    :param root: places are shown relative to it.
    """

    def __init__(
        self, path: Path, root: Path, files: Files, packages: Packages, context: Context
    ) -> None:
        self._context = context
        self._evaluator = Evaluator(context, packages.folder)
        project = Project.of_paths([path], root, files)
        self._source = project.given[0]
        self._place = Place(self._source.shown, 1, 1)
        model = launch_model(packages.folder, self._performed, self._configurations)
        self._machine = _LaunchInterpreter(project, model, World())
        self._machine.world.is_program = True
        self._values = Values(self._machine)
        self._actions = Actions(self._machine, self._follow, self._bounded)

    def actions(self) -> Sequence[Action]:
        """What the file does."""
        if self._source.tree is None:
            why = next((d.message for d in self._source.diagnostics), 'it is no Python')
            return [Unfollowed(place=self._place, why=Unknown(why))]
        found: list[Action] = []

        def follow() -> None:
            module = self._machine.run_module(self._source, _START)
            found.extend(self._described(module))

        return self._bounded(follow, self._place) or found

    def _described(self, module: Module) -> list[Action]:
        function = module.slots.get(_START)
        if not isinstance(function, Function):
            why = Unknown(f'no function {_START} is found')
            return [Unfollowed(place=self._place, why=why)]
        description = self._machine.call(function, Call(function.place))
        return self._actions.of_description(description, function.place)

    def _bounded(self, act: Callable[[], None], place: Place) -> list[Action]:
        """Do ``act``; what is too large or nested too deeply is reported."""
        machine, context = self._machine, self._context
        machine.steps = context.steps
        machine.step_limit = min(context.steps + _STEPS, _STEPS_IN_ALL)
        try:
            with scanning_limits():
                act()
        except BudgetError:
            return [Unfollowed(place=place, why=Unknown('it is too long to be followed'))]
        except RecursionError:
            return [Unfollowed(place=place, why=Unknown('it is nested too deeply'))]
        finally:
            context.steps = machine.steps
            machine.stack.clear()
            machine.depth = 0
            machine.world.path, machine.world.stopped = (), False
            machine.store.reset()
        return []

    def _performed(self, substitution: Value, place: Place) -> Value:
        """``perform(context)``: known where the function of an ``OpaqueFunction`` is followed."""
        value = self._evaluator.value(self._values.expression(substitution, place))
        if isinstance(value, Unknown):
            return Mystery(Unknown(value.reason, value.at or place), 'perform(context)')
        return Const(value)

    def _configurations(self, context: Instance) -> Value:
        entries: dict[Value, Value] = {
            Const(name): Const(value)
            if isinstance(value, str)
            else Mystery(value, f'launch argument {name}')
            for name, value in self._context.scope.configurations.items()
        }
        return Mapping(entries)

    def _follow(self, function: Value, call: Call) -> Callable[[object], Sequence[Action]]:
        """What ``OpaqueFunction(function=…, args=…)`` gives, when its turn comes."""
        items, _ = self._values.items(call.argument(None, 'args'), call.place)
        given = call.argument(None, 'kwargs')
        keywords = {
            str(key.value): value
            for key, value in (given.entries.items() if isinstance(given, Mapping) else ())
            if isinstance(key, Const)
        }

        def actions(_context: object) -> Sequence[Action]:
            found: list[Action] = []

            def follow() -> None:
                context = self._machine.call_library(
                    Library(f'{PREFIX}{CONTEXT}'), Call(call.place)
                )
                arguments = Call(call.place, [context, *items], keywords)
                found.extend(
                    self._actions.of_description(
                        self._machine.call(function, arguments), call.place
                    )
                )

            return self._bounded(follow, call.place) or found

        return actions


def read_python(
    path: Path, root: Path, files: Files, packages: Packages, context: Context
) -> Sequence[Action]:
    """
    The actions of a Python launch file.

    :raises InputError: when it cannot be read.
    """
    if not files.is_file(path):
        raise InputError('no such launch file', Place(str(path)))
    return PythonFile(path, root, files, packages, context).actions()
