"""A process as a launch file starts it: what it runs, and what it is given."""

from __future__ import annotations

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.system.names import Remap

Fact = str | Unknown
"""A text, or why it is unknown."""
ANY_NODE = '/**'
ENTRY, RECORDED, RUNNING = 'entry', 'recorded', 'running'
"""Kinds of processes that no launch file starts."""
TIMER, START_OF_PROCESS = 'timer', 'start of a process'
_BESIDE = ('', TIMER, START_OF_PROCESS)


@dataclass(frozen=True, kw_only=True)
class SetParameter:
    """
    A parameter that the launch sets.

    :param node: pattern of the names of the nodes for which it is set; ``ANY_NODE`` for all.
    """

    name: str
    value: object
    node: str = ANY_NODE
    source: Place | None = None


@dataclass(frozen=True, kw_only=True)
class Launched:
    """
    One process, or one node that a container loads.

    :param kind: ``node``, ``lifecycle``, ``process``, ``container``, ``composable``; ``ENTRY`` of
        code, ``RECORDED`` of a recording, ``RUNNING`` of the graph.
    :param package: ``None`` for what is started by its file.
    :param name: that the launch gives to every node of the process; ``None`` where the code does.
    :param namespace: the same for the namespace.
    :param command: of ``ExecuteProcess``, its words.
    :param conditional: why it may not be started.
    :param later: what begins it, where that is not the start of the launch.
    :param open: facts that are unknown, with why: ``parameters``, ``remappings`` …
    """

    kind: str
    source: Place
    package: Fact | None = None
    executable: Fact | None = None
    name: Fact | None = None
    namespace: Fact | None = None
    remaps: tuple[Remap, ...] = ()
    parameters: tuple[SetParameter, ...] = ()
    command: tuple[str, ...] = ()
    conditional: Unknown | None = None
    later: str = ''
    open: tuple[tuple[str, Unknown], ...] = ()

    @property
    def is_beside_others(self) -> bool:
        """Whether it runs beside what the launch starts at once, and not only behind its end."""
        return self.later in _BESIDE
