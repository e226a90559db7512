"""
Whether what a node meets outside is there; a request without a server is lost for good.

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import os
import time

# For a stimulus that calls all services and offers all that is asked for.
PATIENCE_S = 8.0


class Surroundings:
    """
    :param path: a file that is there once they are; empty where there is nothing to wait for.
    """

    def __init__(self, path: str) -> None:
        self._path = path
        self._asked_since: float | None = None
        self.ready_since: float | None = None

    def are_ready(self) -> bool:
        """Whether they are there, or were not in all the time since this was first asked."""
        if self.ready_since is None:
            now = time.monotonic()
            if self._asked_since is None:
                self._asked_since = now
            given_up = now - self._asked_since > PATIENCE_S
            if not self._path or given_up or os.path.exists(self._path):  # noqa: PTH110
                self.ready_since = now
        return self.ready_since is not None
