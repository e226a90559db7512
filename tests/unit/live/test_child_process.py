"""A command runs as if we were not there, and what it held is written whatever comes then."""

from __future__ import annotations

import signal
from collections.abc import Iterator

import pytest

from ros2cc_extract.extract.live.child_process import deaf_to_ctrl_c


@pytest.fixture
def hears_ctrl_c() -> Iterator[None]:
    """Also where a shell runs the tests in the background, which begin with it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures('hears_ctrl_c')
def test_ctrl_c_meanwhile_is_dropped_and_heard_again_afterwards() -> None:
    with deaf_to_ctrl_c():
        signal.raise_signal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
