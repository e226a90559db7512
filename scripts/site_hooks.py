"""What `make site` does beside MkDocs: nodes in their places, rules, and the playground."""

from __future__ import annotations

import re
import shutil
import sys
from itertools import groupby
from pathlib import Path
from typing import Any

from mkdocs.exceptions import PluginError
from playground_parts import ROOT, LeftOutError, make_parts
from shown_nodes import expanded

from ros2cc_extract.findings.rules.registry import RULES
from ros2cc_extract.version import __version__

RULE_KINDS = {
    '1': 'Waits that never end',
    '2': 'Starvation and delay',
    '3': 'Races',
    '4': 'Settings without effect',
    '5': 'What was not followed',
    '6': 'Demands of your own',
}
PARTS = ROOT / 'build' / 'playground'
FENCE_OF_A_FILE = re.compile(r'^```(\w+) ([\w./-]+)$', re.MULTILINE)
FROM_THE_NET = re.compile(
    r'<(?:script|img|iframe|source)\b[^>]*\bsrc="?(?:https?:)?//'
    r'|<link\b[^>]*\bhref="?(?:https?:)?//'
)


def on_config(config: Any) -> Any:
    """Each rule has its place in the navigation, by what it is about."""
    (rules,) = (part for part in config.nav if 'Rules' in part)
    for kind, members in groupby(RULES, key=lambda rule: rule.code[2]):
        pages = [{f'{rule.code} {rule.slug}': f'rules/{rule.code}.md'} for rule in members]
        rules['Rules'].append({RULE_KINDS[kind]: pages})
    config.copyright = f'ros2cc-extract {__version__}, Apache-2.0'
    shutil.rmtree(PARTS, ignore_errors=True)
    try:
        make_parts(PARTS)
    except LeftOutError as error:
        print(f'the playground is left out: {error}', file=sys.stderr)
        config.nav = [part for part in config.nav if 'Playground' not in part]
    return config


def on_files(files: Any, **_: Any) -> Any:
    """Without its parts the playground has no page."""
    for file in list(files):
        if file.src_uri.startswith('playground/') and not PARTS.exists():
            files.remove(file)
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """A fence that names a file becomes a titled one; a link to a node becomes the node."""
    titled = FENCE_OF_A_FILE.sub(r'```\1 title="\2"', markdown)
    return expanded(titled, Path(page.file.abs_src_path).parent)


def on_post_page(output: str, page: Any, **_: Any) -> str:
    """A reader's browser asks nobody but the site itself."""
    asked = FROM_THE_NET.search(output)
    if asked is not None:
        raise PluginError(f'{page.file.src_uri} loads from the net: {asked[0]}')
    return output


def on_post_build(config: Any, **_: Any) -> None:
    """What the playground loads lies beside its page."""
    if PARTS.exists():
        shutil.copytree(PARTS, Path(config.site_dir) / 'playground', dirs_exist_ok=True)
