"""The pages name what there is: links lead somewhere, commands, options and rules exist."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import COMMANDS
from ros2cc_extract.findings.rules.registry import BY_CODE
from ros2cc_extract.pipeline.config import KEYS
from tests.e2e.conftest import ROOT

PAGES = sorted([*(ROOT / 'docs').rglob('*.md'), ROOT / 'README.md', ROOT / 'ARCHITECTURE.md'])
LINK = re.compile(r'\]\((?!https?:)([^)#\s]+)[^)]*\)')
WORDS_AFTER_NAME = re.compile(r'ros2cc-extract (\w+) ')
CODE = re.compile(r'\bCC\d{3}\b')


@pytest.mark.parametrize('page', PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    targets = LINK.findall(page.read_text(encoding='utf-8'))
    assert [name for name in targets if not (page.parent / name).exists()] == []


@pytest.mark.parametrize('page', PAGES, ids=lambda page: page.name)
def test_rules_that_pages_name_exist(page: Path) -> None:
    named = set(CODE.findall(page.read_text(encoding='utf-8')))
    assert named - set(BY_CODE) == set()


def test_every_setting_is_told() -> None:
    text = (ROOT / 'docs' / 'ci.md').read_text(encoding='utf-8')
    assert [key for key in KEYS if f'\n{key} = ' not in text] == []


def test_commands_of_the_tutorial_exist() -> None:
    text = (ROOT / 'docs' / 'tutorial.md').read_text(encoding='utf-8')
    assert set(WORDS_AFTER_NAME.findall(text)) - {'arm'} <= set(COMMANDS)
