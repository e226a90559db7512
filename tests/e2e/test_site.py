"""The pages of symptoms: what they show is found, and mended, as their words say."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from scripts.shown_nodes import SHOWN, expanded, faulty_twin, printed, source
from tests.e2e.conftest import ROOT

QUESTIONS = ROOT / 'docs' / 'questions'
FOUND = {
    'service-call-hangs.md': {'navigator.py': (['CC101', 'CC403'], [])},
    'subscription-starves.md': {'tracker.py': (['CC202', 'CC401'], [])},
    'threads-behave-like-one.md': {'arm.py': (['CC201', 'CC401'], [])},
    'callbacks-race.md': {'counter.py': (['CC301'], [])},
    'action-never-ends.md': {'mover.py': (['CC203'], []), 'rover.py': (['CC101'], [])},
    'ctrl-c.md': {'exporter.py': (['CC109', 'CC110'], [])},
    'undecided.md': {'beacon.py': (['CC120'], [])},
}
"""The node of each page: what is found in it, and in its mended twin."""
SYMPTOMS = sorted(path.name for path in QUESTIONS.glob('*.md') if path.name != 'README.md')


def shown_on(page: str) -> dict[str, dict[str, Path]]:
    """What each node of a page is shown by: title of the link, and file."""
    shown: dict[str, dict[str, Path]] = {}
    for name, target, title in SHOWN.findall((QUESTIONS / page).read_text(encoding='utf-8')):
        shown.setdefault(name, {})[title] = (QUESTIONS / target).resolve()
    return shown


def codes(name: str, path: Path) -> list[str]:
    found = re.findall(
        rf'^{re.escape(name)}:\d+:\d+: \w+ (CC\d+)', printed(name, source(path)), re.M
    )
    return [str(code) for code in found]


@pytest.mark.parametrize('page', SYMPTOMS)
def test_what_a_page_shows_is_found_and_mended(page: str) -> None:
    shown = shown_on(page)
    assert {
        name: (codes(name, paths['the node']), codes(name, paths['the change']))
        for name, paths in shown.items()
    } == FOUND[page]


@pytest.mark.parametrize('page', SYMPTOMS)
def test_a_page_shows_the_node_its_findings_and_the_change_of_it(page: str) -> None:
    for paths in shown_on(page).values():
        assert list(paths) == ['the node', 'what is printed', 'the change']
        node = paths['the node']
        assert (paths['what is printed'], faulty_twin(paths['the change'])) == (node, node)


def test_every_symptom_is_in_the_list_and_in_the_navigation() -> None:
    overview = (QUESTIONS / 'README.md').read_text(encoding='utf-8')
    navigation = (ROOT / 'mkdocs.yml').read_text(encoding='utf-8')
    assert sorted(re.findall(r'\]\(([\w-]+\.md)\)', overview)) == SYMPTOMS
    assert sorted(re.findall(r'questions/([a-z-]+\.md)$', navigation, re.M)) == SYMPTOMS


def test_links_to_nodes_become_what_they_stand_for(tmp_path: Path) -> None:
    node = (
        'import rclpy\nfrom rclpy.node import Node\n\n\nrclpy.init()\nnode = Node("a")\n'
        'node.create_timer(1.0, lambda: print("a"))\nrclpy.spin(node)\n'
    )
    (tmp_path / 'quiet.py').write_text(f'"""Says what it is."""\n\n{node}\n# finds: nothing\n')
    page = 'Look:\n\n[one.py](quiet.py "the node")\n\nand [this](quiet.py "the node") stays.\n'
    assert expanded(page, tmp_path) == (
        'Look:\n\n```python title="one.py" linenums="1" hl_lines=""\n'
        f'{node}```\n\nand [this](quiet.py "the node") stays.\n'
    )
