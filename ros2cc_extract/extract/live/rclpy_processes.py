"""Which processes of this user run rclpy, as far as ``/proc`` shows."""

from __future__ import annotations

import os
from pathlib import Path

from ros2cc_extract.file_ownership import user_of_process

_PROC = Path('/proc')
# The part of rclpy in C++; processes with rclpy have it in memory (``impl/``, 1.0 and later).
_LIBRARY = b'_rclpy_pybind11'


def rclpy_processes() -> list[int]:
    """
    Give the processes of this user that have loaded rclpy, in ascending order; never this one.

    Those of containers are left out: what is handed to a process lies in our folders, not theirs.
    """
    numbers = sorted(int(each.name) for each in _PROC.iterdir() if each.name.isdecimal())
    return [each for each in numbers if each != os.getpid() and _runs_rclpy(_PROC / str(each))]


def _runs_rclpy(process: Path) -> bool:
    try:
        is_own = user_of_process(int(process.name)) == os.geteuid()
        return is_own and _is_beside_us(process) and _LIBRARY in (process / 'maps').read_bytes()
    except OSError:  # it has ended, or we may not look at it
        return False


def _is_beside_us(process: Path) -> bool:
    return all(
        (process / 'ns' / each).readlink() == (_PROC / 'self' / 'ns' / each).readlink()
        for each in ('mnt', 'net')
    )
