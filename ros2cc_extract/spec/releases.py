"""
Which releases of rclpy behave in which way.

A major number is one distribution's line (3 Humble, 4 Iron, 7 Jazzy, 9 Kilted, 8, 10 and later
Rolling); a change reaches each line in a release of its own.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

Release = tuple[int, int, int]
_RELEASE = re.compile(r'(\d+)\.(\d+)\.(\d+)')


def release_of(version: str | None) -> Release | None:
    """The numbers of ``7.1.6`` or ``7.1.6-1jammy``; ``None`` for what is no release."""
    found = _RELEASE.match(version or '')
    return (int(found[1]), int(found[2]), int(found[3])) if found else None


def has_change(version: str | None, first: Mapping[int, Release]) -> bool | None:
    """
    Whether a release has a change.

    :param first: the first release with it, by line; lines before the earliest lack it, lines
        after the latest have it.
    :return: ``None`` where the version, or what became of its line, is not known.
    """
    release = release_of(version)
    if release is None:
        return None
    line = release[0]
    if line in first:
        return release >= first[line]
    if line > max(first):
        return True
    return False if line < min(first) else None


# What follows was read in the change logs of rclpy and in the sources of 3.3.10, 3.3.21, 7.1.6,
# 7.1.9, 7.1.11, 9.1.2, 9.1.5 and 10.0.10 (``executors.py``, ``task.py``).
SPIN_REFUSED_TWICE = {7: (7, 1, 9), 9: (9, 1, 5), 10: (10, 0, 1)}
"""An executor that spins refuses to be spun (ros2/rclpy pull request 1510); not by 3.3.21."""

TASKS_OLDEST_FIRST = {3: (3, 3, 21), 4: (5, 0, 0), 7: (7, 1, 9), 8: (8, 0, 0)}
"""Of several tasks that wait the oldest is served first, before that the newest (1469)."""

NODE_STAYS = {3: (3, 3, 15), 7: (7, 1, 2)}
"""``spin_until_future_complete`` takes out only a node that it has added (1316)."""

TIMEOUT_KEEPS_HARVEST = {3: (3, 3, 11), 7: (7, 0, 0)}
"""Spinning with a time-out walks through all that is ready (1165)."""

DESTROYED_SPIN_GOES_ON = {9: (9, 1, 2)}
"""A wait survives that an entity is destroyed meanwhile (measured; 8.0 was not tried)."""

SHUTDOWN_WAITS_NOT = {4: (4, 0, 0)}
"""A callback that shuts its executor down goes on (measured on 3.3.21, 7.1.6 and 9.1.2)."""

FUTURE_YIELDS_ITSELF = {3: (3, 3, 21), 7: (7, 1, 9), 9: (9, 1, 4), 10: (10, 0, 3)}
"""
``Future.__await__`` yields the future, which asyncio refuses (1469, 1560).

Whoever makes it done, be it a thread of the user's own, wakes the executor then.
"""

COROUTINES_IN_EVENTS = {7: (7, 1, 11), 9: (9, 1, 2), 10: (10, 0, 1)}
"""``EventsExecutor`` runs coroutine callbacks of services and subscriptions (1478, 1613)."""
