"""
Follow the actions of launch files in their order, and list what they start.

Source: launch_ros (Jazzy) ``actions/node.py`` (what is in ``arguments`` comes first on the command
line, then name, namespace, parameters and remaps, those of the scope before its own; rcl takes the
first remap that matches and the last value of a parameter).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.launch.language.actions import (
    Action,
    ChangeState,
    Computed,
    Declare,
    Group,
    Include,
    PushNamespace,
    PushParameters,
    PushRemap,
    SetConfiguration,
    StartNode,
    StartProcess,
    Unfollowed,
)
from ros2cc_extract.extract.launch.language.context import Context, Value
from ros2cc_extract.extract.launch.language.evaluation import Evaluator
from ros2cc_extract.extract.launch.language.substitutions import Expression
from ros2cc_extract.extract.launch.process_facts import ProcessFacts, allowed
from ros2cc_extract.extract.launch.workspace.packages import Packages
from ros2cc_extract.source_locations import Place, Unknown, shown_name
from ros2cc_extract.spec.system.launched import Launched
from ros2cc_extract.spec.system.names import Remap, joined_namespace

_DEEPEST = 25
_MOST_ACTIONS = 50_000
# Some thousand processes, or fewer with more that is said of each.
_MOST_COST, _COST_OF_PROCESS, _COST_OF_FACT, _LETTERS_FOR_ONE = 100_000, 100, 4, 100
Load = Callable[[Path, Context], Sequence[Action]]
UNRESOLVED = 'launch-unresolved'
"""Slug of what a launch file says that could not be resolved."""
UNSET = 'launch-argument-unset'
"""Slug of an argument without a value: what needs it reports it."""


class Execution:
    """
    One launch, from its first file.

    :param load: reads a launch file.
    :ivar found: what is started, in order.
    :ivar noticed: what could not be followed.
    :ivar changes_states: it may itself configure or activate life-cycle nodes.
    :ivar files: launch files that were read, as shown.
    """

    def __init__(self, context: Context, packages: Packages, load: Load) -> None:
        self.found: list[Launched] = []
        self.noticed: list[Diagnostic] = []
        self.files: list[Path] = []
        self.changes_states = False
        self._context = context
        self._load = load
        self._packages = packages
        self._evaluator = Evaluator(context, packages.folder)
        self._facts = ProcessFacts(context, self._evaluator, packages)
        self._doubts: list[Unknown] = []
        self._later: list[str] = []
        self._depth = self._steps = self._cost = 0

    def include(self, path: Path) -> None:
        """Follow a launch file."""
        self.files.append(path)
        with self._context.within(str(path)):
            self._all(self._load(path, self._context))

    def _all(self, actions: Sequence[Action]) -> None:
        for action in actions:
            self._steps += 1
            if self._steps > _MOST_ACTIONS or self._depth > _DEEPEST:
                self._note(action.place, Unknown('launch file is too large to be followed'))
                return
            with self._doubted(action) as is_taken:
                if is_taken:
                    self._depth += 1
                    self._one(action)
                    self._depth -= 1

    @contextmanager
    def _doubted(self, action: Action) -> Iterator[bool]:
        """
        Whether the action may be taken; what it starts is conditional where that is open.

        Inside, it is taken; what it sets is not known behind it.
        """
        doubts = [action.open] if action.open is not None else []
        holds = True if action.condition is None else self._evaluator.holds(action.condition)
        if isinstance(holds, Unknown):
            doubts.append(Unknown(holds.reason, holds.at or action.place))
        self._doubts += doubts
        before = self._context.scope
        try:
            yield holds is not False
        finally:
            del self._doubts[len(self._doubts) - len(doubts) :]
            if doubts and self._context.join(before, doubts[-1]):
                self._note(action.place, Unknown('remap of the scope is not known'))

    def _one(self, action: Action) -> None:
        if isinstance(action, StartNode):
            self._start(self._facts.of_node(action))
            for loaded in action.loaded:
                self._all([loaded])
        elif isinstance(action, StartProcess):
            self._start(self._facts.of_process(action))
        elif isinstance(action, Group):
            self._group(action)
        elif isinstance(action, Include):
            self._include(action)
        elif isinstance(action, Computed):
            self._all(action.function(self._context))
        elif isinstance(action, ChangeState):
            self.changes_states = True
        elif isinstance(action, Unfollowed):
            self._note(action.place, action.why)
        else:
            self._set(action)

    def _start(self, launched: Launched) -> None:
        was_followed, self._cost = self._cost <= _MOST_COST, self._cost + _cost_of(launched)
        if self._cost > _MOST_COST:
            if was_followed:
                self._note(launched.source, Unknown('launch starts more than can be followed'))
            return
        conditional = self._doubts[-1] if self._doubts else None
        later = self._later[-1] if self._later else ''
        self.found.append(replace(launched, conditional=conditional, later=later))

    def _set(self, action: Action) -> None:
        scope = self._context.scope
        if isinstance(action, Declare):
            self._declare(action)
        elif isinstance(action, SetConfiguration):
            self._set_configuration(action)
        elif isinstance(action, PushNamespace):
            pushed = self._evaluator.value(action.namespace)
            below = allowed(_below(scope.namespace, pushed))
            self._context.scope = replace(scope, namespace=below)
        elif isinstance(action, PushRemap):
            old = allowed(self._evaluator.value(action.old))
            new = allowed(self._evaluator.value(action.new))
            if isinstance(old, Unknown) or isinstance(new, Unknown):
                self._note(action.place, Unknown('remap of the scope is not known'))
            else:
                remap = Remap(old=old, new=new, source=action.place)
                self._context.scope = replace(scope, remaps=(*scope.remaps, remap))
        elif isinstance(action, PushParameters):
            parameters = (*scope.parameters, *action.parameters)
            self._context.scope = replace(scope, parameters=parameters)

    def _declare(self, action: Declare) -> None:
        name = self._evaluator.value(action.name)
        if isinstance(name, Unknown):
            return
        default = None if action.default is None else self._evaluator.value(action.default)
        if default is not None:
            default = _at(default, action.place)
        if not self._context.declare(name, default):
            why = f'launch argument {name!r} has no default: give {name}:=VALUE'
            self._context.set(name, Unknown(why, action.place))
            self.noticed.append(
                Diagnostic(
                    severity=Severity.NOTE,
                    slug=UNSET,
                    place=action.place,
                    message=why,
                    help='what depends on it is not known',
                )
            )

    def _set_configuration(self, action: SetConfiguration) -> None:
        name = self._evaluator.value(action.name)
        if isinstance(name, Unknown):
            self._note(action.place, name)
        elif action.value is None:
            self._context.unset_configuration(name)
        else:
            self._context.set(name, self._evaluator.value(action.value))

    def _group(self, action: Group) -> None:
        self._later += [action.later] if action.later else []
        given = dict(self._pairs(action.configurations))
        if action.scoped:
            with self._context.group():
                if not action.forwarding:
                    self._context.only({})
                for name, value in given.items():
                    self._context.set(name, value)
                self._all(action.actions)
        else:
            self._all(action.actions)
        del self._later[len(self._later) - bool(action.later) :]

    def _pairs(
        self, pairs: Sequence[tuple[Expression, Expression]]
    ) -> Iterator[tuple[str, Value]]:
        for name, value in pairs:
            known = self._evaluator.value(name)
            if not isinstance(known, Unknown):
                yield known, self._evaluator.value(value)

    def _include(self, action: Include) -> None:
        path = self._evaluator.value(action.path)
        if action.open_arguments is not None:
            self._note(action.place, action.open_arguments)
        for name, value in list(self._pairs(action.arguments)):
            self._context.set(name, value)
        if isinstance(path, Unknown):
            self._note(action.place, Unknown(f'included launch file: {path.reason}', path.at))
            return
        file = Path(path)
        if self.files.count(file) > _DEEPEST:
            self._note(action.place, Unknown('launch file includes itself'))
        elif not self._packages.has(file):
            self._note(action.place, Unknown(f'included launch file {path} is not there'))
        else:
            self.include(file)

    def _note(self, place: Place, why: Unknown) -> None:
        self.noticed.append(
            Diagnostic(
                severity=Severity.NOTE,
                slug=UNRESOLVED,
                place=place,
                message=f'not followed: {why}',
                help='what it would start is missing from the system',
            )
        )


def _cost_of(launched: Launched) -> int:
    """What comes after grows with it: each node has what rclpy makes, under names of its own."""
    texts = (launched.name, launched.namespace, *launched.remaps, *launched.command)
    letters = sum(len(str(each)) for each in texts if each is not None)
    facts = len(launched.remaps) + len(launched.parameters)
    return _COST_OF_PROCESS + _COST_OF_FACT * facts + letters // _LETTERS_FOR_ONE


def _below(base: Value | None, pushed: Value) -> Value:
    if isinstance(pushed, Unknown) or isinstance(base, Unknown):
        return pushed if isinstance(pushed, Unknown) else base or pushed
    return joined_namespace(base or '', pushed)


def _at(value: Value, place: Place) -> Value:
    return Unknown(value.reason, value.at or place) if isinstance(value, Unknown) else value


def shown_path(path: Path, root: Path) -> str:
    """A path as it is shown: below ``root`` relative to it."""
    is_below = path.is_relative_to(root)
    return shown_name((path.relative_to(root) if is_below else path).as_posix())
