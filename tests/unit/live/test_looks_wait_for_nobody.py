"""A look at a process takes no lock of it: a thread that hangs may hold it."""

from __future__ import annotations

import threading
from types import SimpleNamespace, TracebackType

from ros2cc_extract.extract.live.hang_analysis import probe


class Handle:
    """As of a context, in C."""

    def __enter__(self) -> Handle:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """The code that destroys it may go on."""

    def get_domain_id(self) -> int:
        return 7


class Context:
    """As of rclpy: `shutdown` holds the lock while it calls back."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.handle = Handle()

    def get_domain_id(self) -> int:
        if not self.lock.acquire(timeout=5):
            raise AssertionError('waits for the lock')
        self.lock.release()
        return 7


def test_the_domain_of_a_context_that_is_being_shut_down() -> None:
    context = Context()
    node = SimpleNamespace(context=context, get_fully_qualified_name=lambda: '/late')
    with context.lock:
        row = probe._node(node)
    assert (row['name'], row['domain']) == ('/late', 7)
