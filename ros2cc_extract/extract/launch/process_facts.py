"""What one action starts, as values: names, remaps and parameters, or why they are not known."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import TypeVar

from ros2cc_extract.extract.launch.language.actions import (
    LIST_OF,
    Constant,
    FromFile,
    Given,
    Listed,
    ParameterSource,
    StartNode,
    StartProcess,
)
from ros2cc_extract.extract.launch.language.command_words import words_of
from ros2cc_extract.extract.launch.language.context import Context, Value
from ros2cc_extract.extract.launch.language.evaluation import Evaluator
from ros2cc_extract.extract.launch.language.substitutions import Expression
from ros2cc_extract.extract.launch.parameter_files import parameters_in, read_value
from ros2cc_extract.extract.launch.typed_values import typed
from ros2cc_extract.extract.launch.workspace.packages import Packages
from ros2cc_extract.source_locations import Place, Unknown, shown_name
from ros2cc_extract.spec.system.launched import Launched, SetParameter
from ros2cc_extract.spec.system.names import Remap, joined_namespace, read_remap

_ROS_ARGUMENTS = '--ros-args'
_REMAP, _PARAMETER, _FILE = ('-r', '--remap'), ('-p', '--param'), ('--params-file',)
# rmw (Jazzy): RMW_NODE_NAME_MAX_NAME_LENGTH, and less for a topic or a namespace.
_MOST_LETTERS = 255
Open = list[tuple[str, Unknown]]
V = TypeVar('V', Value, Value | None)


class ProcessFacts:
    """Finds what is started in the current scope."""

    def __init__(self, context: Context, evaluator: Evaluator, packages: Packages) -> None:
        self._context = context
        self._evaluator = evaluator
        self._packages = packages
        self._read: dict[str, Sequence[SetParameter] | Unknown] = {}

    def of_node(self, action: StartNode) -> Launched:
        """What ``Node`` and the like start."""
        open_facts: Open = list(action.open_facts)
        arguments, remaps = self._arguments(action.arguments, action.place, open_facts)
        remaps += self._context.scope.remaps
        remaps += self._remaps(action, open_facts)
        sources = (*self._context.scope.parameters, *action.parameters)
        parameters = (*arguments, *self._parameters(sources, open_facts))
        return Launched(
            kind=action.kind,
            source=action.place,
            package=self._optional(action.package),
            executable=self._optional(action.executable),
            name=allowed(self._optional(action.name) or None),
            namespace=allowed(self._namespace(action.namespace)),
            remaps=tuple(remaps),
            parameters=tuple(parameters),
            open=tuple(open_facts),
        )

    def of_process(self, action: StartProcess) -> Launched:
        """What ``ExecuteProcess`` starts."""
        open_facts: Open = []
        if action.open_words is not None:
            open_facts.append(('command', action.open_words))
        words: list[str] = []
        for expression in self._words(action.command, action.place, open_facts):
            value = self._evaluator.value(expression)
            if isinstance(value, Unknown):
                open_facts.append(('command', value))
                words.append('…')
            else:
                words.append(value)
        given: tuple[SetParameter, ...] = ()
        remaps: list[Remap] = []
        if _ROS_ARGUMENTS in words:
            given, remaps = self._ros_arguments(words, action.place, open_facts)
        return Launched(
            kind='process',
            source=action.place,
            command=tuple(words),
            remaps=tuple(remaps),
            parameters=given,
            open=tuple(open_facts),
        )

    def _optional(self, expression: Expression | None) -> Value | None:
        return None if expression is None else self._evaluator.value(expression)

    def _namespace(self, expression: Expression | None) -> Value | None:
        own, base = self._optional(expression), self._context.scope.namespace
        if own is None or isinstance(own, Unknown):
            return own or base
        if isinstance(base, Unknown):
            return joined_namespace('', own) if own.startswith('/') else base
        return joined_namespace(base or '', own) if own else base

    def _remaps(self, action: StartNode, open_facts: Open) -> Iterator[Remap]:
        for old, new in action.remaps:
            left, right = (allowed(self._evaluator.value(each)) for each in (old, new))
            why = next((each for each in (left, right) if isinstance(each, Unknown)), None)
            if why is not None:
                open_facts.append(('remappings', why))
                continue
            remap = read_remap(f'{left}:={right}', action.place)
            if remap is not None:
                yield remap

    def _parameters(
        self, sources: Sequence[ParameterSource], open_facts: Open
    ) -> Iterator[SetParameter]:
        for source in sources:
            if isinstance(source, FromFile):
                path = self._evaluator.value(source.path)
                yield from self._from_file(path, open_facts)
                continue
            name = self._evaluator.value(source.name)
            if isinstance(name, Unknown):
                open_facts.append(('parameters', name))
                continue
            yield SetParameter(name=name, value=self._given(source), source=source.place)

    def _given(self, source: Given) -> object:
        if isinstance(source.value, Constant):
            return source.value.value
        if not isinstance(source.value, Listed):
            text = self._evaluator.value(source.value)
            return text if isinstance(text, Unknown) else typed(text, source.kind)
        of_one = source.kind.removeprefix(LIST_OF)
        values: list[object] = []
        for item in source.value.items:
            text = self._evaluator.value(item)
            value = text if isinstance(text, Unknown) else typed(text, of_one)
            if isinstance(value, Unknown):
                return value
            values.append(value)
        return tuple(values)

    def _from_file(self, path: Value, open_facts: Open) -> Iterator[SetParameter]:
        if isinstance(path, Unknown):
            open_facts.append(('parameters', Unknown(f'parameter file: {path.reason}', path.at)))
            return
        if not self._packages.has(Path(path)):
            open_facts.append(('parameters', Unknown(f'parameter file {path} is not there')))
            return
        found = self._read.get(path)
        if found is None:
            content = self._packages.content(Path(path))
            found = (
                Unknown('parameter file cannot be read', Place(shown_name(path)))
                if content is None
                else parameters_in(content, shown_name(path))
            )
            self._read[path] = found
        if isinstance(found, Unknown):
            open_facts.append(('parameters', found))
        else:
            yield from found

    def _arguments(
        self, arguments: Sequence[Expression], place: Place, open_facts: Open
    ) -> tuple[tuple[SetParameter, ...], list[Remap]]:
        words: list[str] = []
        for expression in self._words(arguments, place, open_facts):
            value = self._evaluator.value(expression)
            if isinstance(value, Unknown):
                open_facts.append(('arguments', value))
            else:
                words.append(value)
        return self._ros_arguments(words, place, open_facts)

    def _words(
        self, command: Sequence[Expression], place: Place, open_facts: Open
    ) -> Sequence[Expression]:
        """A command in one text is divided, as XML and YAML files have it."""
        if len(command) != 1:
            return command
        try:
            return words_of(command[0])
        except ValueError:
            open_facts.append(('command', Unknown('a quotation in it is not closed', place)))
            return ()

    def _ros_arguments(
        self, words: Sequence[str], place: Place, open_facts: Open
    ) -> tuple[tuple[SetParameter, ...], list[Remap]]:
        """``--ros-args -r old:=new -p name:=value --params-file FILE``."""
        parameters: list[SetParameter] = []
        remaps: list[Remap] = []
        for flag, word in pairwise(words):
            if flag in _REMAP:
                remap = read_remap(word, place)
                remaps += [remap] if remap is not None else []
            elif flag in _PARAMETER:
                name, assigns, value = word.partition(':=')
                if assigns:
                    parameters.append(
                        SetParameter(name=name, value=read_value(value), source=place)
                    )
            elif flag in _FILE:
                parameters.extend(self._from_file(word, open_facts))
        return tuple(parameters), remaps


def allowed(name: V) -> V | Unknown:
    """A name, unless it is longer than ROS takes: a process with it does not come up."""
    if isinstance(name, str) and len(name) > _MOST_LETTERS:
        return Unknown(f'name of {len(name)} letters: ROS allows {_MOST_LETTERS}')
    return name
