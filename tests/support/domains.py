"""DDS domains of the tests that run real rclpy: no two test processes use one at a time."""

from __future__ import annotations

import fcntl
import itertools
import random
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

# The ports of domains up to 101 stay below Linux' ephemeral ports.
DOMAINS = range(1, 102)
# A domain is not used again soon: what a killed node announced stays known for a while.
_DOMAINS_IN_TURN = itertools.cycle(random.sample(DOMAINS, len(DOMAINS)))


@contextmanager
def free_domain() -> Iterator[int]:
    """Hold a DDS domain that no other test process on this machine uses."""
    with free_domains(1) as numbers:
        yield numbers[0]


@contextmanager
def free_domains(count: int) -> Iterator[range]:
    """Hold so many domains in a row, for whoever takes them as a range."""
    for first in itertools.islice(_DOMAINS_IN_TURN, len(DOMAINS)):
        numbers = range(first, first + count)
        with ExitStack() as held:
            if numbers[-1] in DOMAINS and all(_is_held(number, held) for number in numbers):
                yield numbers
                return
    pytest.fail('all DDS domains are in use by other test processes')


def _is_held(number: int, held: ExitStack) -> bool:
    """Hold a domain if nobody else does."""
    path = Path(tempfile.gettempdir()) / f'ros2cc-test-domain-{number}.lock'
    if not path.exists():
        path.touch()
    lock = held.enter_context(path.open())  # another user may have made it
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
