"""The script of the HTML page, run by a headless Chromium where there is one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from report_samples import CALL, NOTE, RACE
from test_html import ARM, arm

from ros2cc_extract.report.html.page import html_report
from ros2cc_extract.report.shared.checked import Checked
from tests.support.chromium import CHROMIUM, Page, opened

LOADING_S = 30.0

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason='there is no Chromium')


@pytest.fixture(scope='module')
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with opened(tmp_path_factory.mktemp('profile')) as page:
        yield page


def shown(browser: Page, folder: Path, checked: Checked, address: str = '') -> Page:
    path = folder / 'report.html'
    path.write_text(html_report(checked), encoding='utf-8')
    browser.ask('Page.navigate', url='about:blank')
    browser.wait('location.href === "about:blank"', LOADING_S)
    browser.ask('Page.navigate', url=f'file://{path}{address}')
    browser.wait(
        'document.readyState === "complete" && location.href !== "about:blank"', LOADING_S
    )
    return browser


def texts(page: Page, selector: str, what: str = 'textContent') -> list[str]:
    """Give the texts of all elements that can be seen."""
    script = (
        f'[...document.querySelectorAll({selector!r})]'
        f'.filter((each) => each.checkVisibility()).map((each) => each.{what})'
    )
    return list(page.value(script))


def test_the_script_draws_timelines_and_arrows(browser: Page, tmp_path: Path) -> None:
    page = shown(browser, tmp_path, arm(CALL, RACE, NOTE), '?theme=dark')
    assert page.value('document.documentElement.dataset.theme') == 'dark'
    assert texts(page, '.stay:not(.rest)', 'title') == [
        'tick: assigned',
        'tick: running',
        'running',
    ]
    assert texts(page, '.says b') == ['From step 2 on, this repeats forever.']
    assert texts(page, '.says .place') == ['src/arm node.py:35:9']
    page.value('document.querySelectorAll(".player button")[1].click()')
    assert texts(page, '.says > div:first-child') == [
        '2. tick starts on thread_0; executor polls src/arm node.py:30:9'
    ]
    assert texts(page, '.says .changes') == ['n = 1']
    assert page.value('document.querySelectorAll(".arrows > path").length') == 1


def test_source_lines_stand_at_their_places(browser: Page, tmp_path: Path) -> None:
    page = shown(browser, tmp_path, arm(CALL))
    assert texts(page, '.finding .source')[0].splitlines() == [
        f'   {n} line {n} <&>' for n in range(38, 43)
    ]
    assert texts(page, '.finding .here .number') == ['   40', '   20', '   10']
    assert texts(page, '.finding .remarks .source') == [
        '   20 line 20 <&>\n',
        '   10 line 10 <&>\n',
    ]


@pytest.mark.parametrize(
    ('words', 'cards', 'units', 'counts'),
    [
        ('', ['CC101', 'CC301', 'CC501'], ['arm', 'leg'], ''),
        ('cc301', ['CC301'], [], '1 of 3 findings'),
        ('UPDATES  arm.count', ['CC301'], [], '1 of 3 findings'),
        ('leg', [], ['leg'], '0 of 3 findings'),
        ('nothing of this', [], [], '0 of 3 findings'),
    ],
)
def test_a_search_shows_what_holds_all_words(
    browser: Page, tmp_path: Path, words: str, cards: list[str], units: list[str], counts: str
) -> None:
    leg = replace(ARM, name='leg', callbacks=(), groups=())
    page = shown(browser, tmp_path, arm(CALL, RACE, NOTE, units=(ARM, leg)))
    page.value(
        f'search = document.querySelector(".search"); search.value = {words!r};'
        'search.dispatchEvent(new Event("input"))'
    )
    assert texts(page, '.finding > header .badge') == cards
    assert texts(page, '.index a') == units
    assert page.value('document.querySelector(".found").value') == counts


def test_notes_open_where_a_search_or_their_tile_shows_them(browser: Page, tmp_path: Path) -> None:
    checked = arm(CALL, *[NOTE] * 11)
    page = shown(browser, tmp_path, checked, '?search=topic')
    assert texts(page, '.finding > header .badge') == ['CC501'] * 11
    page = shown(browser, tmp_path, checked)
    assert texts(page, '.finding > header .badge') == ['CC101']
    page.value('document.querySelector(".tile.note").click()')
    assert texts(page, '.finding > header .badge') == ['CC501'] * 11
    page.value('document.querySelector(".tile.note").click()')
    assert texts(page, '.finding > header .badge') == ['CC101']


def test_a_link_opens_what_it_leads_to(browser: Page, tmp_path: Path) -> None:
    checked = arm(CALL, *[NOTE] * 11, units=(ARM,) * 4)
    page = shown(browser, tmp_path, checked, '#finding-9')
    assert page.value('document.querySelector(".notes").open')
    page.value('document.querySelector(".index a").click()')
    page.wait('document.querySelector(".unit").open', LOADING_S)
    assert len(texts(page, '.executor')) == 1
    assert page.value('document.querySelectorAll(".arrows > path").length') == 1
    page.value('document.querySelector(".finding .about a").click()')
    page.wait('document.querySelector("#rule-CC101").open', LOADING_S)


def test_what_is_not_asked_for_is_not_drawn(browser: Page, tmp_path: Path) -> None:
    page = shown(browser, tmp_path, arm(*[RACE] * 4))
    assert page.value('document.querySelectorAll(".timeline").length') == 0
    page.value('document.querySelector(".run > summary").click()')
    page.wait('document.querySelectorAll(".timeline").length', LOADING_S)
    assert texts(page, '.stay:not(.rest)', 'title') == [
        'tick: assigned',
        'tick: running',
        'running',
    ]
