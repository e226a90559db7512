"""The page shows who waits for what and what keeps it, and is no more than a page."""

from __future__ import annotations

import os
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind
from ros2cc_extract.extract.live.hang_analysis.page import as_html
from tests.unit.hang_proof.snapshots import entity, hang, stands

DRIVE, CLIENT = 1, 3
HOSTILE = '<script>alert(1)</script>\x1b[31m'


class Reader(HTMLParser):
    """Keeps the tags, and the text that is shown."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.words: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.tags.append(tag)

    def handle_data(self, data: str) -> None:
        if self.tags[-1:] != ['style'] and data.strip():
            self.words.append(data.strip())


def test_page_says_who_waits_for_what_and_what_keeps_it(tmp_path: Path) -> None:
    node = tmp_path / 'node.py'
    node.write_text('  self.client.call(request)  # <here>\n')
    entities = [entity(DRIVE, 'timers', 10), entity(CLIENT, 'clients', 10, key='/s', there=True)]
    waits = stands(
        DRIVE,
        Kind.ANSWER,
        CLIENT,
        file=str(node),
        function='drive',
        reasons=('its callback group is closed by drive',),
    )
    explanation = replace(hang(entities, waits), proof='proven by the model')
    assert Reader(as_html((explanation,))).words == [
        'Why it hangs',
        'Why it hangs',
        'process 7 (/n)',
        'deadlock',
        ': nothing is left that could end a wait',
        '(proven by the model)',
        'drive',
        '(t)',
        f'{node}:1',
        'self.client.call(request)  # <here>',
        'waits forever for →',
        'the answer of service /s',
        '→',
        'its callback group is closed by drive',
        'MultiThreadedExecutor of /n',
    ]


def test_names_of_the_process_are_text_and_its_files_are_only_read_if_they_are_files() -> None:
    entities = [entity(DRIVE, 'timers', 10), entity(CLIENT, 'clients', 10, key=HOSTILE)]
    waits = stands(
        DRIVE, Kind.ANSWER, CLIENT, file=os.devnull, function=HOSTILE, reasons=(HOSTILE,)
    )
    page = as_html((hang(entities, waits),))
    read = Reader(page)
    assert 'script' not in read.tags
    assert '\x1b' not in page
    assert sum('<script>alert(1)</script>' in each for each in read.words) == 3
