"""From objects of a Python launch file to expressions, conditions and lists of actions' parts."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.launch.language.actions import (
    Condition,
    Constant,
    FromFile,
    Given,
    Listed,
    ParameterSource,
)
from ros2cc_extract.extract.launch.language.substitutions import (
    Configuration,
    Evaluated,
    Expression,
    Logic,
    Path,
    Share,
    Substitution,
    Text,
    ThisFile,
    Unresolved,
    Variable,
    text,
    unresolved,
)
from ros2cc_extract.extract.launch.python.table import Made
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.containers import Mapping, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Instance,
    Mystery,
    Native,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown

_LOGIC = {
    'NotSubstitution': 'not',
    'AndSubstitution': 'and',
    'OrSubstitution': 'or',
    'AnySubstitution': 'or',
    'AllSubstitution': 'and',
    'EqualsSubstitution': 'equals',
    'NotEqualsSubstitution': 'not-equals',
    'IfElseSubstitution': 'if',
}
_CONDITIONS = {
    'IfCondition': 'if',
    'UnlessCondition': 'unless',
    'LaunchConfigurationEquals': 'equals',
    'LaunchConfigurationNotEquals': 'differs',
}
_STEPS_OF_ONE = 2
_BUILTINS = 'builtins.'
_SCALARS = (str, int, float, bool)


def made(value: Value | None) -> Made | None:
    """What launch knows of an object; ``None`` if it is not an object of launch."""
    state = value.state if isinstance(value, Instance) else None
    return state if isinstance(state, Made) and state.call is not None else None


def why_open(value: Value, place: Place) -> Unknown:
    """Why a value is not known."""
    if isinstance(value, Mystery):
        return Unknown(value.unknown.reason, value.unknown.at or place)
    return Unknown('it depends on a branch or is computed at run time', place)


def _kind(value: Value) -> str:
    """The type that ``ParameterValue(…, value_type=…)`` gives to what is evaluated."""
    state = made(value)
    if state is None or state.call is None or state.kind != 'ParameterValue':
        return ''
    kind = state.call.argument(1, 'value_type')
    return kind.name.removeprefix(_BUILTINS) if isinstance(kind, Native) else ''


def _of_one_type(values: list[object]) -> tuple[object, ...]:
    """launch_ros makes doubles of whole numbers beside doubles."""
    if {type(value) for value in values} == {int, float}:
        return tuple(map(float, values))  # type: ignore[arg-type]
    return tuple(values)


class Values:
    """Reads the values of one followed file."""

    def __init__(self, machine: Machine) -> None:
        self._machine = machine

    def items(self, value: Value | None, place: Place) -> tuple[list[Value], Unknown | None]:
        """
        The items of a list, and why there may be more.

        :raises BudgetError: as ``expression``.
        """
        self._machine.charge(_STEPS_OF_ONE)
        if value is None or value == NONE:
            return [], None
        if isinstance(value, Mystery):
            return [], why_open(value, place)
        if isinstance(value, Instance):
            return [value], None
        items, rest = self._machine.items_of(value, place)
        return list(items), rest

    def expression(self, value: Value | None, place: Place) -> Expression:
        """
        What a text, a substitution or a list of these stands for.

        :raises BudgetError: where so much is made of it, an object that stands in several places
            once for each.
        """
        self._machine.charge(_STEPS_OF_ONE)
        if value is None or value == NONE:
            return ()
        if isinstance(value, Const):
            is_scalar = isinstance(value.value, _SCALARS)
            return text(str(value.value)) if is_scalar else unresolved(why_open(value, place))
        if isinstance(value, Sequence):
            items, rest = self.items(value, place)
            more = (Unresolved(rest),) if rest is not None else ()
            parts = [self.expression(item, place) for item in items]
            return (*(part for each in parts for part in each), *more)
        state = made(value)
        if state is None or state.call is None:
            return unresolved(why_open(value, place))
        return self._substitution(state.kind, state.call)

    def _substitution(self, kind: str, call: Call) -> Expression:
        first = self.expression(call.argument(0, 'text', 'package', 'expression'), call.place)
        if kind in _LOGIC:
            return (Logic(_LOGIC[kind], self._operands(call)),)
        if kind in ('TextSubstitution', 'ParameterFile', 'ParameterValue'):
            names = ('text', 'param_file', 'value')
            return self.expression(call.argument(0, *names), call.place)
        if kind == 'LaunchConfiguration':
            name = self.expression(call.argument(0, 'variable_name'), call.place)
            return (Configuration(name, self._default(call)),)
        if kind in ('EnvironmentVariable', 'OptionalEnvironmentVariable'):
            name = self.expression(call.argument(0, 'name'), call.place)
            return (Variable(name, self._default(call)),)
        if kind == 'PathJoinSubstitution':
            items, rest = self.items(call.argument(0, 'substitutions'), call.place)
            parts = [self.expression(item, call.place) for item in items]
            return (Path((*parts, unresolved(rest)) if rest else tuple(parts)),)
        simple: dict[str, Substitution] = {
            'FindPackageShare': Share(first),
            'PythonExpression': Evaluated(first),
            'ThisLaunchFileDir': ThisFile(is_folder=True),
            'ThisLaunchFile': ThisFile(is_folder=False),
        }
        if kind in simple:
            return (simple[kind],)
        return unresolved(Unknown(f'{kind} is known at the launch alone', call.place))

    def _operands(self, call: Call) -> tuple[Expression, ...]:
        found = [*call.args, *call.keywords.values()]
        return tuple(self.expression(each, call.place) for each in found)

    def _default(self, call: Call) -> Expression | None:
        value = call.argument(None, 'default', 'default_value')
        if value is None and len(call.args) > 1:
            value = call.args[1]
        return None if value is None or value == NONE else self.expression(value, call.place)

    def condition(self, value: Value | None, place: Place) -> Condition | Unknown | None:
        """The condition of an action."""
        if value is None or value == NONE:
            return None
        state = made(value)
        operator = _CONDITIONS.get(state.kind) if state is not None else None
        if state is None or state.call is None or operator is None:
            return Unknown(f'condition: {why_open(value, place).reason}', place)
        first = self.expression(
            state.call.argument(0, 'predicate_expression', 'launch_configuration_name'), place
        )
        if operator in ('if', 'unless'):
            return Condition(operator, (first,))
        expected = self.expression(state.call.argument(1, 'expected_value'), place)
        return Condition(operator, ((Configuration(first, text('')),), expected))

    def pairs(
        self, value: Value | None, place: Place
    ) -> tuple[tuple[tuple[Expression, Expression], ...], Unknown | None]:
        """Pairs of texts, as of remaps and arguments, and why there may be more."""
        if isinstance(value, Mapping):
            found = [(key, entry) for key, entry in value.entries.items()]
            more = value.rest
        else:
            items, more = self.items(value, place)
            found = []
            for item in items:
                parts, rest = self.items(item, place)
                if len(parts) == 2 and rest is None:
                    found.append((parts[0], parts[1]))
                else:
                    more = more or why_open(item, place)
        pairs = ((self.expression(a, place), self.expression(b, place)) for a, b in found)
        return tuple(pairs), more

    def parameters(
        self, value: Value | None, place: Place
    ) -> tuple[tuple[ParameterSource, ...], Unknown | None]:
        """The parameters of a node, and why there may be more."""
        items, rest = self.items(value, place)
        found: list[ParameterSource] = []
        for item in items:
            for option in options_of(item):
                if isinstance(option, Mapping):
                    found.extend(self._entries(option, (), place))
                    rest = rest or option.rest
                elif made(option) is not None and made(option).kind == 'Parameter':  # type: ignore[union-attr]
                    found.extend(self._parameter(option))
                elif isinstance(option, Mystery):
                    rest = rest or why_open(option, place)
                else:
                    found.append(FromFile(self.expression(option, place), place))
        return tuple(found), rest

    def _parameter(self, value: Value) -> Iterator[ParameterSource]:
        call = made(value).call  # type: ignore[union-attr]
        assert call is not None
        name = self.expression(call.argument(0, 'name'), call.place)
        yield Given(
            name, self.constant_or_text(call.argument(1, 'value') or NONE, call.place), call.place
        )

    def _entries(
        self, value: Mapping, prefix: Expression, place: Place
    ) -> Iterator[ParameterSource]:
        for key, entry in value.entries.items():
            self._machine.charge(_STEPS_OF_ONE)
            name = (*prefix, *self.expression(key, place))
            if isinstance(entry, Mapping):
                yield from self._entries(entry, (*name, Text('.')), place)
            else:
                given = self.constant_or_text(entry, place)
                yield Given(name, given, place, _kind(entry))

    def constant_or_text(self, value: Value, place: Place) -> Constant | Listed | Expression:
        """A constant with its type; a substitution is a text that YAML reads."""
        state = made(value)
        if state is not None and state.call is not None and state.kind == 'ParameterValue':
            inner = state.call.argument(0, 'value')
            return self.constant_or_text(inner or NONE, place)
        if isinstance(value, Const):
            return Constant(value.value)
        if isinstance(value, Sequence) and value.rest is None:
            plain = [item.value for item in value.items if isinstance(item, Const)]
            if len(plain) == len(value.items):
                return Constant(_of_one_type(plain))
            if plain == [] and all(isinstance(item, Sequence) for item in value.items):
                return Listed(tuple(self.expression(item, place) for item in value.items))
        return self.expression(value, place)
