"""Interpreters that have rclpy: the usual one, and that of a second distribution."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

INTERPRETER_VARIABLE = 'ROS2CC_RCLPY_PYTHON'
KILTED_VARIABLE = 'ROS2CC_KILTED_PYTHON'
EVERY_RELEASE = (INTERPRETER_VARIABLE, KILTED_VARIABLE)
#: For what takes long: on the usual one each time, on every release with ``-m slow``.
EVERY_RELEASE_AT_LEISURE = (
    INTERPRETER_VARIABLE,
    pytest.param(KILTED_VARIABLE, marks=pytest.mark.slow),
)


def interpreter_of(variable: str) -> str:
    """Give the interpreter that a variable names; skip where it has no rclpy."""
    usual = sys.executable if variable == INTERPRETER_VARIABLE else ''
    python = os.environ.get(variable, usual)
    tried = (
        python
        and subprocess.run(
            [python, '-c', 'import rclpy'], capture_output=True, check=False
        ).returncode
    )
    if not python or tried:
        pytest.skip(f'no rclpy in {python!r}; set {variable} to a Python that has it')
    return python
