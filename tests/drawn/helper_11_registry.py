"""Who has been heard, and when."""

import threading
import time
from contextlib import contextmanager


class Registry:
    """Peers by name; kept small by `prune`."""

    def __init__(self, ttl: float):
        self._ttl = ttl
        self._peers = {}
        self._mutex = threading.RLock()

    @contextmanager
    def locked(self):
        with self._mutex:
            yield self

    @property
    def peers(self):
        return self._peers

    def touch(self, name):
        with self._mutex:
            self._peers[name] = time.monotonic()

    def prune(self):
        now = time.monotonic()
        with self._mutex:
            for name in [n for n, t in self._peers.items() if now - t > self._ttl]:
                del self._peers[name]
