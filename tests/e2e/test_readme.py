"""The README shows what its commands really print."""

from __future__ import annotations

import re

from ros2cc_extract.cli.main import COMMANDS
from tests.e2e.conftest import ROOT, Run

README = (ROOT / 'README.md').read_text(encoding='utf-8')
COST = re.compile(r'^.* states, .* peak memory .*$', re.MULTILINE)


def test_the_output_of_make_demo_is_the_one_shown(run: Run) -> None:
    makefile = (ROOT / 'Makefile').read_text(encoding='utf-8')
    recipe = re.search(r'^demo:.*\n\t\$\(BIN\)/ros2cc-extract (\S+)', makefile, re.MULTILINE)
    assert recipe is not None
    printed = run(recipe.group(1), cwd=ROOT).out
    shown = README.split('```')[3].removeprefix('\n')
    assert COST.sub('', shown) == COST.sub('', printed)


def test_every_command_is_told() -> None:
    assert [name for name in COMMANDS if name not in README] == []
