"""Register with pytest the markers of the test file that ``ros2cc-extract init`` writes."""

from __future__ import annotations

from typing import Protocol


class Config(Protocol):
    """What is used of ``pytest.Config``; pytest itself is no dependency."""

    def addinivalue_line(self, name: str, line: str) -> None:
        """Add one line to a setting that is a list."""


def pytest_configure(config: Config) -> None:
    """Declare the markers; ``linter`` is ament_lint's, which may not be installed."""
    config.addinivalue_line('markers', 'ros2cc: checks the callbacks of the nodes of a package')
    config.addinivalue_line('markers', 'linter: marks linter tests')
