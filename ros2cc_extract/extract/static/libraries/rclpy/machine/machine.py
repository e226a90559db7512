"""What a machine that models rclpy offers to its tables."""

from __future__ import annotations

from abc import ABC, abstractmethod

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld
from ros2cc_extract.extract.static.python.values.values import Instance, Value
from ros2cc_extract.source_locations import Place


class RosMachine(ConcurrentMachine, ABC):
    """Notes of nodes, spins and messages."""

    world: RosWorld

    @abstractmethod
    def become_node(self, instance: Instance) -> Instance | None:
        """Treat an instance of a class with an unknown base as the node it is used as."""

    @abstractmethod
    def note_nested_spin(
        self,
        how: str,
        node: Instance | None,
        executor: Value,
        future: tuple[Value | None, Value | None],
        place: Place,
        change: str = '',
    ) -> bool:
        """
        Whether a spin stands in a callback; then it is noted there and is no set-up.

        :param node: the node that moves by it; without one nothing does.
        :param future: what it waits for, with the time-out.
        :param change: how ``node`` moves, in words.
        """

    @abstractmethod
    def note_change(self, what: str, node: Instance, place: Place) -> None:
        """A callback changes which executor serves ``node``."""

    @abstractmethod
    def note_publish(self, publisher: Value, place: Place) -> None:
        """A message is published."""
