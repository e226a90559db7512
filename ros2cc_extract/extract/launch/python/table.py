"""
launch and launch_ros as a table for the interpreter: objects that keep how they were made.

Source: launch, launch_ros (Jazzy). Classes are known by their last name, in whichever module of
these packages they stand. ``values.py`` finds what an object means, once the file was
followed to its end, since lists may be filled behind its making.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from ros2cc_extract.extract.launch.python import paths
from ros2cc_extract.extract.static.python.builtins import builtin_functions
from ros2cc_extract.extract.static.python.machine.library_state import LibraryState
from ros2cc_extract.extract.static.python.machine.library_table import (
    Library,
    LibraryClass,
    LibraryModel,
)
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Handler,
    Instance,
    Value,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

PREFIX = 'launch.'
ADDED = '__added__'
_PACKAGES = ('launch.', 'launch_ros.', 'launch_xml.', 'launch_yaml.')
_SHARE = 'ament_index_python.packages.get_package_share_directory'
DESCRIPTION = 'LaunchDescription'
CLASSES = frozenset(
    """
    LaunchDescription Node LifecycleNode ExecuteProcess ExecuteLocal ComposableNodeContainer
    LoadComposableNodes IncludeLaunchDescription GroupAction PushRosNamespace PushROSNamespace
    SetRemap SetParameter SetParametersFromFile SetUseSimTime DeclareLaunchArgument
    SetLaunchConfiguration UnsetLaunchConfiguration ResetLaunchConfigurations OpaqueFunction
    RegisterEventHandler UnregisterEventHandler TimerAction RosTimer LogInfo
    SetEnvironmentVariable UnsetEnvironmentVariable AppendEnvironmentVariable
    ResetEnvironment PushEnvironment PopEnvironment PushLaunchConfigurations
    PopLaunchConfigurations EmitEvent Shutdown LifecycleTransition SetROSLogDir
    OnProcessStart OnProcessExit OnProcessIO OnExecutionComplete OnShutdown OnStateTransition
    OnIncludeLaunchDescription EventHandler ChangeState
    LaunchConfiguration TextSubstitution PathJoinSubstitution PythonExpression FindPackageShare
    FindPackagePrefix FindPackage EnvironmentVariable OptionalEnvironmentVariable
    ThisLaunchFileDir ThisLaunchFile Command FindExecutable LocalSubstitution
    NotSubstitution AndSubstitution OrSubstitution EqualsSubstitution NotEqualsSubstitution
    IfElseSubstitution AnySubstitution AllSubstitution
    IfCondition UnlessCondition LaunchConfigurationEquals LaunchConfigurationNotEquals
    PythonLaunchDescriptionSource XMLLaunchDescriptionSource YAMLLaunchDescriptionSource
    FrontendLaunchDescriptionSource AnyLaunchDescriptionSource LaunchDescriptionSource
    ComposableNode ParameterValue ParameterFile Parameter
    """.split()  # noqa: SIM905
)
CONTEXT = 'LaunchContext'
Perform = Callable[[Value, Place], Value]
Configurations = Callable[[Instance], Value]
ShareOf = Callable[[str], Path | None]


@dataclass(eq=False)
class Made(LibraryState):
    """An object of launch: its class by its last name, and the call that made it."""

    is_block = True

    kind: str
    call: Call | None = None


def _state(kind: str) -> Callable[[Machine, Instance], Made]:
    return lambda machine, instance: Made(kind)


def _keep(machine: Machine, receiver: Value, call: Call) -> Value:
    """What it was made with; the class of its own that a file derives hands that on."""
    if isinstance(receiver, Instance) and isinstance(receiver.state, Made):
        receiver.state.call = call
    return NONE


def _begin(machine: Machine, receiver: Value, call: Call) -> Value:
    """A description; what is added to it later is kept apart from what it is made with."""
    if isinstance(receiver, Instance):
        machine.store.write(receiver, ADDED, Sequence((), 'list'))
    return _keep(machine, receiver, call)


def _add(machine: Machine, receiver: Value, call: Call) -> Value:
    """``LaunchDescription.add_action`` and ``add_entity``."""
    assert isinstance(receiver, Instance)
    if call.args or call.keywords:
        added = _added(machine, receiver)
        item = call.args[0] if call.args else next(iter(call.keywords.values()))
        machine.call(machine.attribute(added, 'append', call.place), Call(call.place, [item]))
    return NONE


def _added(machine: Machine, receiver: Instance) -> Value:
    known = receiver.slots.get(ADDED)
    return known if isinstance(known, Value) else Sequence((), 'list')


def _performer(perform: Perform) -> Handler:
    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        """``substitution.perform(context)``, where the configurations are known."""
        assert isinstance(receiver, Instance)
        return perform(receiver, call.place)

    return handler


def _perform_all(perform: Perform) -> Handler:
    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        """``perform_substitutions(context, substitutions)``: what they give, one after another."""
        given = call.argument(1, 'subs', 'substitutions')
        if given is None:
            return machine.mystery('substitutions that could not be followed', call.place)
        return perform(given, call.place)

    return handler


def _normalized(machine: Machine, receiver: Value, call: Call) -> Value:
    """``normalize_to_list_of_substitutions``: the same, in a list."""
    given = call.argument(0, 'subst')
    if isinstance(given, Sequence):
        return given
    return NONE if given is None else Sequence((given,), 'list')


def _entities(machine: Machine, receiver: Instance, place: Place) -> Value:
    return _added(machine, receiver)


def _share(share_of: ShareOf) -> Handler:
    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        name = call.argument(0, 'package_name', 'package')
        if not isinstance(name, Const) or not isinstance(name.value, str):
            return machine.mystery('package that could not be followed', call.place)
        folder = share_of(name.value)
        if folder is None:
            return machine.mystery(f'package {name.value} is not found', call.place)
        return Const(str(folder))

    return handler


class _LaunchModel(LibraryModel):
    """Classes of launch by their last names."""

    def other_name(self, name: str) -> str:
        """The class of that name, in whichever module of launch it stands."""
        last = name.rpartition('.')[2]
        is_known = name.startswith(_PACKAGES) and last in CLASSES
        return f'{PREFIX}{last}' if is_known else name


def launch_model(
    share_of: ShareOf, perform: Perform, configurations: Configurations
) -> LibraryModel:
    """
    What is known of launch, beside Python itself.

    :param share_of: the folder of a package.
    :param perform: what a substitution is in the context of the moment.
    :param configurations: ``context.launch_configurations``.
    """
    methods: dict[str, Handler] = {'perform': _performer(perform)}
    classes = {
        f'{PREFIX}{name}': LibraryClass(state=_state(name), init=_keep, methods=methods)
        for name in CLASSES
    }
    classes[f'{PREFIX}{DESCRIPTION}'] = LibraryClass(
        state=_state(DESCRIPTION),
        init=_begin,
        methods={'add_action': _add, 'add_entity': _add},
        properties={'entities': _entities},
    )
    classes[f'{PREFIX}{CONTEXT}'] = LibraryClass(
        state=_state(CONTEXT),
        init=_keep,
        properties={'launch_configurations': lambda machine, owner, place: configurations(owner)},
        methods={
            'perform_substitution': lambda machine, receiver, call: (
                perform(call.args[0], call.place)
                if call.args and isinstance(call.args[0], Instance)
                else machine.mystery('a substitution that could not be followed', call.place)
            )
        },
    )
    share = _share(share_of)
    classes[f'{PREFIX}FindPackageShare'] = LibraryClass(
        state=_state('FindPackageShare'), init=_keep, methods={**methods, 'find': share}
    )
    functions: dict[str, Handler] = {
        _SHARE: share,
        'ament_index_python.get_package_share_directory': share,
        'ament_index_python.packages.get_package_share_path': share,
        'ament_index_python.get_package_share_path': share,
        **{
            f'launch.utilities.{module}perform_substitutions': _perform_all(perform)
            for module in ('', 'perform_substitutions_impl.')
        },
        'launch.utilities.normalize_to_list_of_substitutions': _normalized,
        'os.path.join': paths.join,
        'pathlib.Path': paths.join,
        'os.path.dirname': paths.changed(os.path.dirname),
        'os.path.abspath': paths.changed(os.path.normpath),
        'os.path.realpath': paths.changed(os.path.normpath),
        'os.path.basename': paths.changed(os.path.basename),
    }
    table = Library(classes=classes, functions=functions)
    return _LaunchModel([builtin_functions.TABLE, table], harmless=('launch', 'os.', 'ament_'))
