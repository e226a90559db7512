"""
What launch files of every form say: one value for each action, in whichever language.

Source: launch and launch_ros (Jazzy) ``actions/``; ``launch_xml`` and ``launch_yaml`` name the
same actions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ros2cc_extract.extract.launch.language.substitutions import Expression
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown

LIST_OF = 'list_of_'
"""Before the type of its items, the type of a list."""


@dataclass(frozen=True)
class Condition:
    """
    When an action is taken.

    :param operator: ``if``, ``unless``, ``equals``, ``differs``.
    """

    operator: str
    operands: tuple[Expression, ...]


@dataclass(frozen=True)
class Constant:
    """A value of a parameter that is written down with its type."""

    value: object


@dataclass(frozen=True)
class Listed:
    """A value of a parameter that is a list of texts, each with its own substitutions."""

    items: tuple[Expression, ...]


@dataclass(frozen=True)
class Given:
    """
    One parameter; ``value`` as it is written, or as a text that YAML reads.

    :param kind: the type that the launch file gives it, as XML names it: ``int``, ``float``,
        ``bool``, ``str``, and these after ``list_of_``. Without one, YAML decides.
    """

    name: Expression
    value: Constant | Listed | Expression
    place: Place
    kind: str = ''


@dataclass(frozen=True)
class FromFile:
    """Parameters of a YAML file."""

    path: Expression
    place: Place


ParameterSource = Given | FromFile


@dataclass(frozen=True, kw_only=True)
class Action:
    """
    What all actions have.

    :param open: why it is not known whether the file has it at all.
    """

    place: Place
    condition: Condition | None = None
    open: Unknown | None = None


@dataclass(frozen=True, kw_only=True)
class StartNode(Action):
    """
    ``Node``, ``LifecycleNode``, a container, or a node that a container loads.

    :param kind: ``node``, ``lifecycle``, ``container``, ``composable``.
    :param name: ``None`` where the code names the node.
    :param arguments: of its command line.
    :param open_facts: facts that could not be followed, with why.
    """

    kind: str
    package: Expression | None
    executable: Expression | None
    name: Expression | None = None
    namespace: Expression | None = None
    remaps: tuple[tuple[Expression, Expression], ...] = ()
    parameters: tuple[ParameterSource, ...] = ()
    arguments: tuple[Expression, ...] = ()
    loaded: tuple[Action, ...] = ()
    open_facts: tuple[tuple[str, Unknown], ...] = ()


@dataclass(frozen=True, kw_only=True)
class StartProcess(Action):
    """``ExecuteProcess``: the words of its command."""

    command: tuple[Expression, ...]
    open_words: Unknown | None = None


@dataclass(frozen=True, kw_only=True)
class Declare(Action):
    """``DeclareLaunchArgument``."""

    name: Expression
    default: Expression | None


@dataclass(frozen=True, kw_only=True)
class SetConfiguration(Action):
    """``SetLaunchConfiguration``, ``let``; without a value it is unset."""

    name: Expression
    value: Expression | None


@dataclass(frozen=True, kw_only=True)
class Include(Action):
    """``IncludeLaunchDescription`` with the arguments that it sets."""

    path: Expression
    arguments: tuple[tuple[Expression, Expression], ...] = ()
    open_arguments: Unknown | None = None


@dataclass(frozen=True, kw_only=True)
class Group(Action):
    """
    Actions together; ``scoped`` ones leave no configuration behind.

    :param later: an event may begin them, or time; not the start of the file.
    """

    actions: tuple[Action, ...]
    scoped: bool = True
    configurations: tuple[tuple[Expression, Expression], ...] = ()
    forwarding: bool = True
    later: str = ''


@dataclass(frozen=True, kw_only=True)
class PushNamespace(Action):
    """``PushRosNamespace``."""

    namespace: Expression


@dataclass(frozen=True, kw_only=True)
class PushRemap(Action):
    """``SetRemap``."""

    old: Expression
    new: Expression


@dataclass(frozen=True, kw_only=True)
class PushParameters(Action):
    """``SetParameter``, ``SetParametersFromFile``, ``SetUseSimTime``."""

    parameters: tuple[ParameterSource, ...]


@dataclass(frozen=True, kw_only=True)
class Computed(Action):
    """``OpaqueFunction``: a function that gives actions once the configurations are known."""

    function: Callable[[object], Sequence[Action]]


@dataclass(frozen=True, kw_only=True)
class ChangeState(Action):
    """What may change the state of a life-cycle node, such as an event that is emitted."""


@dataclass(frozen=True, kw_only=True)
class Unfollowed(Action):
    """What may start processes, and could not be followed."""

    why: Unknown
