"""
Quality of service: profiles keep how they were made, and what is set on them later.

Source: rclpy 7.1.6, ``qos.py`` (a profile takes what is not given from ``qos_profile_default``).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.python.machine.library_state import LibraryState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.values import NONE, Call, Instance, Value
from ros2cc_extract.light_dataclasses import dataclass

PROFILE = 'rclpy.qos.QoSProfile'


@dataclass(eq=False)
class ProfileState(LibraryState):
    """The call that made a profile."""

    call: Call | None = None


def _keep(machine: RosMachine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance) and isinstance(receiver.state, ProfileState):
        receiver.state.call = call
    return NONE


TABLE = Library(
    classes={
        PROFILE: LibraryClass(state=lambda machine, instance: ProfileState(), init=_keep),
    },
)
