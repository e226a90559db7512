"""
Every library class and function with a known effect: one row in one of the tables.

To add an API: a row in the table of its library, and a case in ``tests/scanner_cases``.
"""

from __future__ import annotations

from functools import cached_property, lru_cache

from ros2cc_extract.extract.static.libraries.qt import threads as qt_threads
from ros2cc_extract.extract.static.libraries.rclpy.machine.waits import WAITS
from ros2cc_extract.extract.static.libraries.rclpy.tables import (
    actions,
    async_nodes,
    called_by_services,
    clients,
    clocks,
    entity_makers,
    events,
    executors,
    groups,
    nodes,
    shutdown,
    spinning_helpers,
    spins,
)
from ros2cc_extract.extract.static.libraries.rclpy.values import parameters, qos
from ros2cc_extract.extract.static.libraries.standard import (
    asyncio_blocks,
    asyncio_loops,
    futures,
    outside_calls,
    queues,
    servers,
    threads,
)
from ros2cc_extract.extract.static.program.relevance import MAKING, MAKING_NAMES
from ros2cc_extract.extract.static.python.builtins import builtin_functions
from ros2cc_extract.extract.static.python.machine.library_table import LibraryModel

_BY_LAST_NAME = frozenset(
    [
        'Node',
        'LifecycleNode',
        'SingleThreadedExecutor',
        'MultiThreadedExecutor',
        'EventsExecutor',
        'Executor',
        'MutuallyExclusiveCallbackGroup',
        'ReentrantCallbackGroup',
        'CallbackGroup',
        'ActionServer',
        'ActionClient',
    ]
)


_HARMLESS = (
    'tf2_ros.',
    'rclpy.',
    'builtins.',
    'rosidl',
    'cv_bridge',
    'diagnostic_updater.',
    'launch',
)
"""Helpers of the ROS libraries that take a node and add nothing its executor would serve."""


_DATA = {
    'builtins.': 'numbers, texts and containers (Python, library reference, *Built-in Types*)',
    'collections.': 'containers that only their own methods change (*collections*)',
    'copy.': 'a copy is of the class of what it is taken of (*copy*)',
    'datetime.': 'values, none of which ever changes (*datetime*, *Aware and Naive Objects*)',
    'json.': 'what is decoded is made of built-in types (*json*, table of conversions)',
    'math.': 'numbers (*math*)',
    'numpy.': 'arrays, changed by assignments and methods (NumPy, reference, ``ndarray``)',
    'pathlib.': 'a path is a value; what it asks the disk is noted where it is called (*pathlib*)',
    're.': 'patterns and matches never change (*re*)',
    'rclpy.duration.': 'a number of nanoseconds (rclpy 7.1.6, ``duration.py``)',
    'rclpy.qos.': 'policies that code sets (``qos.py``)',
    'rclpy.time.': 'a number of nanoseconds; only a clock gives a new one (``time.py``)',
    'types.': 'name spaces that only assignments change (*types*, ``SimpleNamespace``)',
    'yaml.': 'what is loaded is made of built-in types (PyYAML, documentation, *YAML tags*)',
}
"""Libraries whose objects change only when the program changes them, and why that is so."""

_INTERFACES = frozenset({'msg', 'srv', 'action'})


_CALLS = frozenset({'call', 'call_async', 'wait_for_service', 'publish', 'declare_parameter'})


class _RosModel(LibraryModel):
    """All tables as one; names that rclpy gives a class in several places mean one class."""

    def other_name(self, name: str) -> str:
        """The class of that name, wherever in rclpy it stands."""
        last = name.rpartition('.')[2]
        if not name.startswith('rclpy.') or last not in _BY_LAST_NAME:
            return name
        return self._by_last_name.get(last, name)

    def makes_data(self, name: str) -> bool:
        """Messages, requests and goals are data: rosidl generates plain classes for them."""
        return super().makes_data(name) or not _INTERFACES.isdisjoint(name.split('.'))

    @cached_property
    def _by_last_name(self) -> dict[str, str]:
        names = (name for name in self.table.classes if name.startswith('rclpy.'))
        return {**{name.rpartition('.')[2]: name for name in names}, 'Node': nodes.NODE}


@lru_cache(maxsize=1)
def model() -> LibraryModel:
    """What is known of Python's own libraries, of rclpy, and of those beside it."""
    return _RosModel(
        [
            builtin_functions.TABLE,
            threads.TABLE,
            futures.TABLE,
            asyncio_loops.TABLE,
            asyncio_blocks.TABLE,
            servers.TABLE,
            queues.TABLE,
            outside_calls.TABLE,
            qt_threads.TABLE,
            groups.TABLE,
            clocks.TABLE,
            nodes.TABLE,
            parameters.TABLE,
            executors.TABLE,
            spins.TABLE,
            clients.TABLE,
            actions.TABLE,
            entity_makers.TABLE,
            spinning_helpers.TABLE,
            events.TABLE,
            called_by_services.TABLE,
            shutdown.TABLE,
            async_nodes.TABLE,
            qos.TABLE,
        ],
        harmless=_HARMLESS,
        making=MAKING,
        acting=MAKING_NAMES | _CALLS,
        waits=WAITS,
        data=tuple(_DATA),
    )
