"""
What of a quality-of-service profile decides whether two endpoints are connected.

Source: rclpy 7.1.6, ``qos.py``: a number is the depth of the default profile, which is reliable
and volatile; the presets as ``rclpy.qos`` of that release has them.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.values.qos import ProfileState
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Instance,
    Library,
    Mystery,
    Value,
)
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.node_graph import Qos

_RELIABLE, _VOLATILE, _AUTOMATIC = 'reliable', 'volatile', 'automatic'
DEFAULT = Qos(reliability=_RELIABLE, durability=_VOLATILE, liveliness=_AUTOMATIC)
_PRESETS = {
    'qos_profile_default': DEFAULT,
    'qos_profile_services_default': DEFAULT,
    'qos_profile_parameters': DEFAULT,
    'qos_profile_parameter_events': DEFAULT,
    'qos_profile_sensor_data': Qos(
        reliability='best_effort', durability=_VOLATILE, liveliness=_AUTOMATIC
    ),
    'qos_profile_action_status_default': Qos(
        reliability=_RELIABLE, durability='transient_local', liveliness=_AUTOMATIC
    ),
}
_WORDS = {
    'reliability': {'RELIABLE': _RELIABLE, 'BEST_EFFORT': 'best_effort'},
    'durability': {'VOLATILE': _VOLATILE, 'TRANSIENT_LOCAL': 'transient_local'},
    'liveliness': {'AUTOMATIC': _AUTOMATIC, 'MANUAL_BY_TOPIC': 'manual_by_topic'},
}


def qos_of(value: Value | None) -> Qos | None:
    """The policies of a profile; ``None`` where it could not be followed."""
    if isinstance(value, Const):
        return DEFAULT if isinstance(value.value, int) else None
    if isinstance(value, Library):
        return _preset(value.name)
    state = value.state if isinstance(value, Instance) else None
    if not isinstance(value, Instance) or not isinstance(state, ProfileState):
        return None
    if state.call is None or state.call.more is not None:
        return None
    return Qos(
        reliability=_policy(value, state.call, 'reliability', _RELIABLE),
        durability=_policy(value, state.call, 'durability', _VOLATILE),
        deadline_s=_seconds(value, state.call, 'deadline'),
        liveliness=_policy(value, state.call, 'liveliness', _AUTOMATIC),
        lease_s=_seconds(value, state.call, 'liveliness_lease_duration'),
    )


def _preset(name: str) -> Qos | None:
    parts = name.removesuffix('.value').split('.')
    is_member = len(parts) > 1 and parts[-2] == 'QoSPresetProfiles'
    return _PRESETS.get(f'qos_profile_{parts[-1].lower()}' if is_member else parts[-1])


def _given(profile: Instance, call: Call, name: str) -> Value | None:
    """What was set last."""
    later = profile.slots.get(name)
    return later if isinstance(later, Value) else call.argument(None, name)


def _policy(profile: Instance, call: Call, name: str, default: str) -> str | Unknown | None:
    value = _given(profile, call, name)
    if value is None:
        return default
    if isinstance(value, Library):
        # What a system or the other end decides is not known, and is no mismatch.
        return _WORDS[name].get(value.name.rpartition('.')[2])
    why = value.unknown if isinstance(value, Mystery) else None
    return why or Unknown(f'{name} depends on a branch', call.place)


def _seconds(profile: Instance, call: Call, name: str) -> float | Unknown | None:
    value = _given(profile, call, name)
    if value is None or value == NONE:
        return None
    state = value.state if isinstance(value, Instance) else None
    seconds = state.key if isinstance(state, PlainState) else None
    if isinstance(seconds, Const) and isinstance(seconds.value, (int, float)):
        return float(seconds.value) or None
    return Unknown(f'{name} is computed', call.place)
