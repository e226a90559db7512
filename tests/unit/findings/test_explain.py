"""The help text of every rule, and the pages made from it."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

from ros2cc_extract.errors import InputError
from ros2cc_extract.findings.base.rule import Rule
from ros2cc_extract.findings.explain import explain, pages
from ros2cc_extract.findings.rules.registry import RULES

DOCS = Path(__file__).parents[3] / 'docs' / 'rules'


def test_explain_finds_a_rule_by_code_and_by_slug() -> None:
    assert explain('cc101') == explain('own-group-call')
    assert explain('CC101').startswith('# CC101 own-group-call: Blocking call into its own')


def test_explain_names_the_rules_there_are() -> None:
    with pytest.raises(InputError, match=r"no rule 'CC999'; the rules are CC101, CC102"):
        explain('CC999')


def test_codes_and_slugs_are_unique_and_in_order() -> None:
    codes = [rule.code for rule in RULES]
    assert codes == sorted(set(codes))
    assert len({rule.slug for rule in RULES}) == len(RULES)


@pytest.mark.parametrize('rule', RULES, ids=lambda rule: rule.code)
def test_every_rule_is_explained(rule: Rule) -> None:
    assert all((rule.title, rule.what, rule.why, rule.bad, rule.good, rule.mend))
    if rule.code < 'CC500':
        assert re.search(r'rclpy (7\.1\.6|10\.0\.10)', rule.why)
    if rule.language == 'python' and rule.slug != 'unreadable':
        ast.parse(rule.bad)
    ast.parse(rule.good)


def test_pages_are_current() -> None:
    """Renew them by ``make rules``."""
    written = {path.name: path.read_text(encoding='utf-8') for path in DOCS.glob('*.md')}
    assert written == pages()
