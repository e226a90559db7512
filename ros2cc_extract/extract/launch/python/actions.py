"""From objects of a Python launch file to actions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from ros2cc_extract.extract.launch.language.actions import (
    Action,
    ChangeState,
    Computed,
    Condition,
    Declare,
    Given,
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
from ros2cc_extract.extract.launch.language.substitutions import text
from ros2cc_extract.extract.launch.python.table import ADDED, DESCRIPTION
from ros2cc_extract.extract.launch.python.values import Values, made, why_open
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    NONE,
    Bound,
    Call,
    Choice,
    Const,
    Function,
    Instance,
    Partial,
    Value,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.system.launched import START_OF_PROCESS, TIMER

_NODES = {
    'Node': 'node',
    'LifecycleNode': 'lifecycle',
    'ComposableNodeContainer': 'container',
    'ComposableNode': 'composable',
}
_EVENTS = {
    'OnProcessStart': ('target_action', 'on_start', START_OF_PROCESS),
    'OnProcessExit': ('target_action', 'on_exit', 'end of a process'),
    'OnProcessIO': ('target_action', 'on_stdout', 'output of a process'),
    'OnExecutionComplete': ('target_action', 'on_completion', 'end of an action'),
    'OnShutdown': (None, 'on_shutdown', 'end of the launch'),
    'OnStateTransition': (None, 'entities', 'state of a life-cycle node'),
    'EventHandler': (None, 'entities', 'event'),
}
_AT_THE_END = 'OnShutdown'
_ROS_ARGUMENTS = Const('--ros-args')
Maker = Callable[[Call], Action]
Follow = Callable[[Value, Call], Callable[[object], Sequence[Action]]]
Bounded = Callable[[Callable[[], None], Place], list[Action]]


class Actions:
    """
    Reads the actions of one followed file.

    :param follow: makes what follows the function of an ``OpaqueFunction``.
    :param bounded: does what the file asks for, and gives what it could not do.
    """

    def __init__(self, machine: Machine, follow: Follow, bounded: Bounded) -> None:
        self._values = Values(machine)
        self._follow = follow
        self._bounded = bounded
        self._makers: dict[str, Maker] = {
            **{name: self._node_of(kind) for name, kind in _NODES.items()},
            'ExecuteProcess': self._process,
            'ExecuteLocal': self._process,
            'LoadComposableNodes': self._load,
            'IncludeLaunchDescription': self._include,
            'GroupAction': self._group,
            'PushRosNamespace': self._push,
            'PushROSNamespace': self._push,
            'SetRemap': self._remap,
            'SetParameter': self._parameter,
            'SetParametersFromFile': self._parameter_file,
            'SetUseSimTime': self._sim_time,
            'DeclareLaunchArgument': self._declare,
            'SetLaunchConfiguration': self._configure,
            'UnsetLaunchConfiguration': self._unset,
            'OpaqueFunction': self._computed,
            'RegisterEventHandler': self._handler,
            'TimerAction': self._timer,
            'RosTimer': self._timer,
            'EmitEvent': self._change_state,
            'LifecycleTransition': self._change_state,
        }

    def of_description(self, value: Value | None, place: Place) -> list[Action]:
        """The actions of a launch description, or of a list of actions."""
        if isinstance(value, Choice):
            return [a for each in value.present for a in self._doubtful(each, place)]
        state = made(value)
        if state is not None and state.kind == DESCRIPTION and isinstance(value, Instance):
            first = self.of_list(state.call.argument(0, 'initial_entities'), place)  # type: ignore[union-attr]
            return [*first, *self._added(value, 0, place)]
        return self.of_list(value, place)

    def _added(self, description: Instance, known: int, place: Place) -> list[Action]:
        """
        What was added behind the first ``known``, and then what is added on the way.

        launch goes through the list of the description itself: what a function of its actions adds
        to it still has its turn.
        """
        items, rest = self._items_added(description, place)
        found = [action for item in items[known:] for action in self._of_item(item, place)]
        if rest is not None:
            return [*found, Unfollowed(place=rest.at or place, why=rest)]
        begin = len(items)

        def follow(_context: object) -> Sequence[Action]:
            more: list[Action] = []

            def look() -> None:
                items, rest = self._items_added(description, place)
                if len(items) > begin or rest is not None:
                    more.extend(self._added(description, begin, place))

            return self._bounded(look, place) or more

        return [*found, Computed(place=place, function=follow)]

    def _items_added(
        self, description: Instance, place: Place
    ) -> tuple[list[Value], Unknown | None]:
        added = description.slots.get(ADDED)
        return self._values.items(added if isinstance(added, Value) else None, place)

    def _doubtful(self, value: Value, place: Place) -> list[Action]:
        why = Unknown('it depends on a branch that is open', place)
        found = self.of_description(value, place)
        return [each if each.open else replace(each, open=why) for each in found]

    def of_list(self, value: Value | None, place: Place) -> list[Action]:
        """The actions of a list; what could not be followed is marked as such."""
        items, rest = self._values.items(value, place)
        found = [action for item in items for action in self._of_item(item, place)]
        if rest is not None:
            found.append(Unfollowed(place=rest.at or place, why=rest))
        return found

    def _of_item(self, item: Value, place: Place) -> list[Action]:
        if isinstance(item, Choice):
            is_partial = any(option is ABSENT or option == NONE for option in item.options)
            options = [option for option in item.present if option != NONE]
            why = Unknown('a branch of the launch file decides', place)
            found = [action for option in options for action in self._of_item(option, place)]
            is_open = is_partial or len(options) > 1
            return [replace(a, open=a.open or why) if is_open else a for a in found]
        state = made(item)
        if state is None or state.call is None:
            if item == NONE:
                return []
            return [Unfollowed(place=place, why=why_open(item, place))]
        if state.kind == DESCRIPTION:
            return self.of_description(item, place)
        maker = self._makers.get(state.kind)
        if maker is None:
            return []
        action = maker(state.call)
        return [self._with_condition(action, item, state.call)]

    def _with_condition(self, action: Action, item: Value, call: Call) -> Action:
        condition = self._values.condition(call.argument(None, 'condition'), call.place)
        path = item.path if isinstance(item, Instance) else ()
        why = Unknown('a branch of the launch file decides', path[-1][0]) if path else None
        if isinstance(condition, Condition):
            return replace(action, condition=condition, open=why)
        return replace(action, open=condition or why)

    def _change_state(self, call: Call) -> Action:
        return ChangeState(place=call.place)

    def _node_of(self, kind: str) -> Maker:
        def make(call: Call) -> Action:
            return self._node(kind, call)

        return make

    def _node(self, kind: str, call: Call) -> Action:
        values, place = self._values, call.place
        by_name = {
            name: values.expression(value, place)
            for name in ('package', 'name', 'namespace', 'executable', 'plugin')
            if (value := call.argument(None, name)) is not None and value != NONE
        }
        remaps, more_remaps = values.pairs(call.argument(None, 'remappings'), place)
        parameters, more = values.parameters(call.argument(None, 'parameters'), place)
        arguments: list[Value] = []
        for name in ('arguments', 'ros_arguments'):
            items, _ = values.items(call.argument(None, name), place)
            prefix = [_ROS_ARGUMENTS] if name == 'ros_arguments' and items else []
            arguments += [*prefix, *items]
        loaded = self.of_list(call.argument(None, 'composable_node_descriptions'), place)
        if call.argument(None, 'autostart') not in (None, Const(False)):
            loaded.append(ChangeState(place=place))
        facts = (('remappings', more_remaps), ('parameters', more), ('arguments', call.more))
        return StartNode(
            place=place,
            kind=kind,
            package=by_name.get('package'),
            executable=by_name.get('executable', by_name.get('plugin')),
            name=by_name.get('name'),
            namespace=by_name.get('namespace'),
            remaps=remaps,
            parameters=parameters,
            arguments=tuple(values.expression(each, place) for each in arguments),
            loaded=tuple(loaded),
            open_facts=tuple((fact, why) for fact, why in facts if why is not None),
        )

    def _process(self, call: Call) -> Action:
        items, more = self._values.items(call.argument(0, 'cmd'), call.place)
        words = tuple(self._values.expression(item, call.place) for item in items)
        return StartProcess(place=call.place, command=words, open_words=more)

    def _load(self, call: Call) -> Action:
        loaded = self.of_list(call.argument(None, 'composable_node_descriptions'), call.place)
        return Group(place=call.place, actions=tuple(loaded))

    def _include(self, call: Call) -> Action:
        source = call.argument(0, 'launch_description_source')
        state = made(source)
        if state is None or state.call is None:
            why = why_open(source or NONE, call.place)
            return Unfollowed(place=call.place, why=Unknown(f'included launch file: {why}'))
        given = state.call.argument(0, 'launch_file_path', 'location')
        pairs, more = self._values.pairs(call.argument(None, 'launch_arguments'), call.place)
        path = self._values.expression(given, call.place)
        return Include(place=call.place, path=path, arguments=pairs, open_arguments=more)

    def _group(self, call: Call) -> Action:
        scoped = call.argument(None, 'scoped')
        forwarding = call.argument(None, 'forwarding')
        pairs, _ = self._values.pairs(call.argument(None, 'launch_configurations'), call.place)
        return Group(
            place=call.place,
            actions=tuple(self.of_list(call.argument(0, 'actions'), call.place)),
            scoped=getattr(scoped, 'value', True) is not False,
            forwarding=getattr(forwarding, 'value', True) is not False,
            configurations=pairs,
        )

    def _push(self, call: Call) -> Action:
        name = self._values.expression(call.argument(0, 'namespace'), call.place)
        return PushNamespace(place=call.place, namespace=name)

    def _remap(self, call: Call) -> Action:
        old = self._values.expression(call.argument(0, 'src'), call.place)
        new = self._values.expression(call.argument(1, 'dst'), call.place)
        return PushRemap(place=call.place, old=old, new=new)

    def _parameter(self, call: Call) -> Action:
        name = self._values.expression(call.argument(0, 'name'), call.place)
        value = self._values.constant_or_text(call.argument(1, 'value') or NONE, call.place)
        given = Given(name, value, call.place)
        return PushParameters(place=call.place, parameters=(given,))

    def _parameter_file(self, call: Call) -> Action:
        given, _ = self._values.parameters(call.argument(0, 'filename'), call.place)
        return PushParameters(place=call.place, parameters=given)

    def _sim_time(self, call: Call) -> Action:
        value = self._values.constant_or_text(call.argument(0, 'value') or NONE, call.place)
        given = Given(text('use_sim_time'), value, call.place)
        return PushParameters(place=call.place, parameters=(given,))

    def _declare(self, call: Call) -> Action:
        default = call.argument(1, 'default_value')
        return Declare(
            place=call.place,
            name=self._values.expression(call.argument(0, 'name'), call.place),
            default=None
            if default is None or default == NONE
            else self._values.expression(default, call.place),
        )

    def _configure(self, call: Call) -> Action:
        name = self._values.expression(call.argument(0, 'name'), call.place)
        value = self._values.expression(call.argument(1, 'value'), call.place)
        return SetConfiguration(place=call.place, name=name, value=value)

    def _unset(self, call: Call) -> Action:
        name = self._values.expression(call.argument(0, 'name'), call.place)
        return SetConfiguration(place=call.place, name=name, value=None)

    def _computed(self, call: Call) -> Action:
        function = call.argument(0, 'function')
        if function is None:
            return Unfollowed(place=call.place, why=Unknown('no function is found'))
        return Computed(place=call.place, function=self._follow(function, call))

    def _handler(self, call: Call) -> Action:
        state = made(call.argument(0, 'event_handler'))
        row = _EVENTS.get(state.kind) if state is not None else None
        if state is None or state.call is None or row is None or state.kind == _AT_THE_END:
            return Group(place=call.place, actions=())
        first, name, what = row
        given = state.call.argument(1 if first else 0, name, 'on_stderr', 'entities')
        return self._later(given, state.call, what)

    def _timer(self, call: Call) -> Action:
        given = call.argument(1, 'actions')
        return self._later(given, call, TIMER)

    def _later(self, given: Value | None, call: Call, what: str) -> Action:
        """What an event begins; a function gives it where that is written instead of a list."""
        if isinstance(given, (Function, Bound, Partial)):
            function = self._follow(given, Call(call.place))
            inner: tuple[Action, ...] = (Computed(place=call.place, function=function),)
        else:
            inner = tuple(self.of_list(given, call.place))
        return Group(place=call.place, actions=inner, scoped=False, later=what)
