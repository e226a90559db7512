"""DDS domains of the tests that run real rclpy: no two test processes use one at a time."""

from __future__ import annotations

import fcntl
import itertools
import random
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

# The ports of domains up to 101 stay below Linux' ephemeral ports.
DOMAINS = range(1, 102)
# A domain is not used again soon: what a killed node announced stays known for a while.
_DOMAINS_IN_TURN = itertools.cycle(random.sample(DOMAINS, len(DOMAINS)))


@contextmanager
def free_domain() -> Iterator[int]:
    """Hold a DDS domain that no other test process on this machine uses."""
    for number in itertools.islice(_DOMAINS_IN_TURN, len(DOMAINS)):
        path = Path(tempfile.gettempdir()) / f'ros2cc-test-domain-{number}.lock'
        with path.open('w') as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                continue
            yield number
            return
    pytest.fail('all DDS domains are in use by other test processes')
