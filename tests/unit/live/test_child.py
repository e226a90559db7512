"""A command runs as if we were not there, and what it held is written whatever comes then."""

from __future__ import annotations

import signal

import pytest

from ros2cc_extract.extract.live.child import deaf_to_ctrl_c


def test_ctrl_c_meanwhile_is_dropped_and_heard_again_afterwards() -> None:
    with deaf_to_ctrl_c():
        signal.raise_signal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
