"""The README shows what its commands really print."""

from __future__ import annotations

from ros2cc_extract.cli.main import COMMANDS
from tests.e2e.expected import README, demo_output, shown_output


def test_the_output_of_make_demo_is_the_one_shown() -> None:
    assert shown_output() == demo_output()


def test_every_command_is_told() -> None:
    text = README.read_text(encoding='utf-8')
    assert [name for name in COMMANDS if name not in text] == []
