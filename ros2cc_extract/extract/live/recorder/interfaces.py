"""
Types and quality of service of what is connected with other nodes.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. Source: rclpy 3.3 to 10, ``publisher.py``, ``subscription.py``, ``service.py``,
``client.py``, ``action/``: the attributes; ``qos.py``: a duration that is not set is 0 or endless.
"""

from __future__ import annotations

from typing import Any

_TYPES = ('msg_type', 'srv_type', '_action_type')
_WORDS = frozenset(
    ('RELIABLE', 'BEST_EFFORT', 'VOLATILE', 'TRANSIENT_LOCAL', 'AUTOMATIC', 'MANUAL_BY_TOPIC')
)
_ENDLESS_NS = 1 << 62


def type_of(entity: Any) -> str | None:
    """``package/kind/Name``; ``None`` where rclpy does not keep it."""
    for name in _TYPES:
        interface = getattr(entity, name, None)
        if isinstance(interface, type):
            parts = interface.__module__.split('.')
            return '/'.join([*parts[:2], interface.__name__]) if len(parts) > 1 else None
    return None


def qos_of(entity: Any) -> dict[str, Any] | None:
    """The policies that decide which endpoints connect; times in seconds, ``None`` if not set."""
    profile = getattr(entity, 'qos_profile', None)
    if profile is None:
        return None
    return {
        'reliability': _word(profile, 'reliability'),
        'durability': _word(profile, 'durability'),
        'deadline_s': _seconds(profile, 'deadline'),
        'liveliness': _word(profile, 'liveliness'),
        'lease_s': _seconds(profile, 'liveliness_lease_duration'),
    }


def _word(profile: Any, name: str) -> str | None:
    """A policy; ``None`` where the middleware decides."""
    word = getattr(getattr(profile, name, None), 'name', None)
    return word.lower() if word in _WORDS else None


def _seconds(profile: Any, name: str) -> float | None:
    nanoseconds = getattr(getattr(profile, name, None), 'nanoseconds', None)
    if isinstance(nanoseconds, int) and 0 < nanoseconds < _ENDLESS_NS:
        return nanoseconds / 1e9
    return None


class PublisherRecord:
    """A publisher, as its node has it."""

    def __init__(self, publisher: Any) -> None:
        topic = getattr(publisher, 'topic', None)
        self.key = topic if isinstance(topic, str) else None
        name = getattr(publisher, 'topic_name', None)
        self.resolved_key = name if isinstance(name, str) else None
        self.type = type_of(publisher)
        self.qos = qos_of(publisher)

    def describe(self) -> dict[str, Any]:
        """As it stands in the recording."""
        return {
            'key': self.key,
            'resolved_key': self.resolved_key,
            'type': self.type,
            'qos': self.qos,
        }
