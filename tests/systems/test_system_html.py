"""The page of a system: its picture, and that a click on an executor leads to its unit."""

from __future__ import annotations

import io
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main
from ros2cc_extract.pipeline.system_sources import scan_launch_files
from ros2cc_extract.report.html.system_page import system_page
from ros2cc_extract.report.shared.system_layout import columns_of
from ros2cc_extract.spec.system.model import System
from tests.support.chromium import CHROMIUM, Page, opened

LAUNCH = Path(__file__).parent / 'launch'
CALLS_BACK = LAUNCH / 'calls_back_bad.launch.py'
NAMES = LAUNCH / 'names_good.launch.py'
LOADING_S = 30.0


class Drawn(HTMLParser):
    """The classes of what is drawn, texts, and where links lead."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.shapes: list[tuple[str, str]] = []
        self.links: list[str] = []
        self.anchors: set[str] = set()
        self.words: list[str] = []
        self._in_picture = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self._in_picture |= tag == 'svg'
        self.anchors.add(given.get('id') or '')
        if self._in_picture:
            self.shapes.append((tag, given.get('class') or ''))
            self.links += [given['href'] or ''] if tag == 'a' else []

    def handle_endtag(self, tag: str) -> None:
        self._in_picture &= tag != 'svg'

    def handle_data(self, data: str) -> None:
        if self._in_picture:
            self.words += [data] if data.strip() else []


def system_of(*paths: Path) -> System:
    return scan_launch_files(paths, {}, io.StringIO(), cached=False).system


def page_of(*words: str) -> str:
    out = io.StringIO()
    assert main(['system', '--no-cache', '--output-format', 'html', *words], out, out) == 0
    return out.getvalue()[out.getvalue().index('<!DOCTYPE') :]


def test_processes_nodes_executors_and_connections_are_drawn() -> None:
    drawn = Drawn(page_of(str(CALLS_BACK)))
    assert drawn.words == [
        *('arm', '/arm', 'MultiThreadedExecutor, 3 threads'),
        *('planner', '/planner', 'MultiThreadedExecutor, 2 threads'),
        *('service /back: std_srvs/srv/Trigger', 'S', '/back'),
        *('service /plan: std_srvs/srv/Trigger', 'S', '/plan'),
    ]
    assert drawn.links == ['#unit-0', '#unit-1']
    assert set(drawn.links) <= {f'#{each}' for each in drawn.anchors}


def test_a_circle_of_waits_is_red_and_what_is_in_none_is_not() -> None:
    shapes = Drawn(page_of(str(CALLS_BACK), str(NAMES))).shapes
    assert shapes.count(('g', 'pill service circle')) == 2
    assert shapes.count(('path', 'arrow circle')) == 4
    assert shapes.count(('g', 'pill service')) == 1
    assert ('g', 'process dashed') not in shapes


def test_what_is_not_in_sight_is_dashed_and_names_are_only_text(tmp_path: Path) -> None:
    path = tmp_path / 'a.launch.xml'
    path.write_text('<launch><node pkg="elsewhere" exec="&lt;b&gt;x"/></launch>', encoding='utf-8')
    text = page_of(str(path))
    drawn = Drawn(text)
    assert ('g', 'process dashed') in drawn.shapes
    assert '<b>x' in drawn.words
    assert '<b>x' not in text


def test_a_check_of_a_launch_file_has_the_picture_with_links_to_its_units() -> None:
    out = io.StringIO()
    words = ['check', '--no-cache', '--output-format', 'html', str(CALLS_BACK)]
    main(words, out, io.StringIO())
    drawn = Drawn(out.getvalue())
    assert sorted(drawn.links) == ['#unit-0', '#unit-1']
    assert {'unit-0', 'unit-1'} <= drawn.anchors


def test_who_asks_stands_on_the_left_and_neighbours_are_near() -> None:
    columns = columns_of(system_of(NAMES, LAUNCH / 'settings_good.launch.py'))
    assert columns.left == ('asker', 'asker_2', 'camera')
    assert columns.right == ('sink', 'good_viewer')
    assert [each.name for each in columns.connections] == [
        '/robot/said',
        '/robot/plan',
        '/said',
        '/image',
    ]


def test_the_same_system_gives_the_same_page() -> None:
    system = system_of(NAMES)
    assert system_page([system]) == system_page([system])


@pytest.fixture(scope='module')
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    if CHROMIUM is None:
        pytest.skip('there is no Chromium')
    with opened(tmp_path_factory.mktemp('profile')) as page:
        yield page


def test_a_click_on_an_executor_opens_its_unit(browser: Page, tmp_path: Path) -> None:
    path = tmp_path / 'system.html'
    path.write_text(page_of(str(CALLS_BACK), str(NAMES)), encoding='utf-8')
    browser.ask('Page.navigate', url=f'file://{path}')
    browser.wait('document.readyState === "complete" && location.href.endsWith("html")', LOADING_S)
    link = 'document.querySelectorAll(".system-picture a")[1]'
    target = f'document.getElementById({link}.getAttribute("href").slice(1))'
    assert browser.value(f'{target}.open') is False
    browser.value(f'{link}.dispatchEvent(new MouseEvent("click", {{bubbles: true}}))')
    browser.wait(f'{target}.open', LOADING_S)
    wide = 'document.documentElement.scrollWidth <= document.documentElement.clientWidth'
    assert browser.value(wide) is True
