"""
Whether the quality of service that a publisher offers meets what a subscription asks for.

Source: docs.ros.org (Jazzy), "Quality of Service settings", tables of compatibilities:
reliability, durability, deadline, liveliness, lease duration.
"""

from __future__ import annotations

from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.node_graph import Qos

_WEAKER = {
    'reliability': ('best_effort', 'reliable'),
    'durability': ('volatile', 'transient_local'),
    'liveliness': ('automatic', 'manual_by_topic'),
}
"""What is offered and what is asked for, where they do not match."""


def mismatch(offered: Qos, asked: Qos) -> str | None:
    """The first policy in which they do not match, in words; ``None`` where none is known."""
    for name, pair in _WEAKER.items():
        if (getattr(offered, name), getattr(asked, name)) == pair:
            return f'{name}: offered {_shown(pair[0])}, asked for {_shown(pair[1])}'
    for name, words in (('deadline_s', 'deadline'), ('lease_s', 'liveliness lease')):
        gives, wants = getattr(offered, name), getattr(asked, name)
        if isinstance(gives, Unknown) or isinstance(wants, Unknown) or wants is None:
            continue
        if gives is None or gives > wants:
            offer = 'none' if gives is None else f'{gives:g} s'
            return f'{words}: offered {offer}, asked for {wants:g} s'
    return None


def _shown(word: str) -> str:
    return word.replace('_', ' ')
