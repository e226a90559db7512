"""The playground of the site: the tool in a Chromium, or left out where parts cannot be had."""

from __future__ import annotations

import functools
import json
import shutil
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from scripts import playground_parts
from scripts.playground_parts import EXAMPLE, LeftOutError, make_parts, pyodide, write_tool
from tests.e2e.conftest import ROOT, Run
from tests.support.chromium import CHROMIUM, Page, opened

SOURCE = ROOT / 'docs' / 'playground'
PLAIN = ('--engine', 'reference', '--no-cache', '--strict', '--max-seconds', '60')
LOADING_S = 200.0
RUNS_IF_RUN = (
    "import js\njs.fetch('/canary')\n__import__('os').mkdir('/canary')\nraise SystemExit\n"
)
CLEAN = (
    'import rclpy\nfrom rclpy.node import Node\nrclpy.init()\nn = Node("n")\n'
    'n.create_timer(1.0, lambda: None)\nrclpy.spin(n)\n'
)
MARKUP = "x = <img src='/canary' onerror='fetch(1)'></pre><script>fetch('/canary')</script>\n"


@pytest.fixture
def _nothing_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A checkout in which nobody has asked npm before."""
    monkeypatch.setattr(playground_parts, 'ROOT', tmp_path)


@pytest.mark.usefixtures('_nothing_kept')
def test_without_npm_it_is_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv('PATH', str(tmp_path))
    with pytest.raises(LeftOutError, match=r'^npm is not here$'):
        make_parts(tmp_path / 'parts')
    assert not (tmp_path / 'parts').exists()


@pytest.mark.usefixtures('_nothing_kept')
@pytest.mark.parametrize(
    ('script', 'error', 'words'),
    [
        ('exit 1', LeftOutError, 'npm does not give pyodide'),
        ('echo evil > pyodide.tgz', ValueError, 'npm gives another pyodide .* than was tried'),
    ],
)
def test_only_what_was_tried_is_taken(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    script: str,
    error: type[Exception],
    words: str,
) -> None:
    npm = tmp_path / 'npm'
    npm.write_text(f'#!/bin/sh\n{script}\n')
    npm.chmod(0o755)
    monkeypatch.setenv('PATH', str(tmp_path))
    with pytest.raises(error, match=words):
        pyodide()
    assert list((tmp_path / '.cache').iterdir()) == []


@dataclass(frozen=True)
class Shown:
    """The page in a browser, and what has been asked of its server."""

    page: Page
    asked: list[str]

    def check(self, text: str) -> str:
        """Paste a text, check it, and give how it ended, without the time that it took."""
        self.page.value(
            f'node.value = {json.dumps(text)}; document.getElementById("check").click()'
        )
        self.page.wait('!document.getElementById("check").disabled', LOADING_S)
        return self.text('state').partition(',')[0]

    def text(self, name: str) -> str:
        return str(self.page.value(f'document.getElementById("{name}").textContent'))


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """The page without the theme around it."""
    folder = tmp_path / 'site'
    try:
        kept = pyodide()
    except LeftOutError as error:
        pytest.skip(str(error))
    shutil.copytree(SOURCE, folder)
    shutil.copytree(kept, folder / 'pyodide')
    write_tool(folder / 'tool.zip')
    shutil.copy(EXAMPLE, folder / 'node.py')
    words = (SOURCE / 'README.md').read_text(encoding='utf-8')
    begin, end = words.index('<div class="playground">'), words.index('</script>')
    page = f'<!doctype html><meta charset="utf-8">{words[begin:end]}</script>'
    (folder / 'index.html').write_text(page, encoding='utf-8')
    return folder


@pytest.fixture
def shown(site: Path, tmp_path: Path) -> Iterator[Shown]:
    asked: list[str] = []

    class Handler(SimpleHTTPRequestHandler):
        def log_message(self, _: str, *words: object) -> None:
            asked.append(str(words[0]))

    handler = functools.partial(Handler, directory=str(site))
    with ThreadingHTTPServer(('127.0.0.1', 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        with opened(tmp_path / 'profile') as page:
            page.ask('Page.navigate', url=f'http://127.0.0.1:{server.server_port}/index.html')
            page.wait('document.getElementById("node")?.value.length > 100', 30.0)
            yield Shown(page, asked)
        server.shutdown()


@pytest.mark.skipif(CHROMIUM is None, reason='there is no Chromium')
def test_a_node_is_read_in_a_browser_and_never_run(shown: Shown, run: Run, tmp_path: Path) -> None:
    # An empty text gives no report: it would read as safe.
    typed = 'node.dispatchEvent(new Event("input")); document.getElementById("check").disabled'
    assert shown.page.value(f'kept = node.value; node.value = ""; {typed}')
    assert not shown.page.value(f'node.value = kept; {typed}')

    # Stopped while it loads, it begins anew.
    shown.page.value('document.getElementById("check").click()')
    shown.page.wait('document.getElementById("state").textContent.startsWith("loading")', 30.0)
    shown.page.value('document.getElementById("stop").click()')
    assert shown.text('state') == 'stopped'

    shutil.copy(EXAMPLE, tmp_path)
    told = run('check', 'node.py', *PLAIN)
    assert shown.check(EXAMPLE.read_text(encoding='utf-8')) == 'findings'
    assert shown.text('findings') == told.out

    shown.page.value('document.querySelector("#findings button").click()')
    chosen = 'node.value.slice(node.selectionStart, node.selectionEnd).trim()'
    assert shown.page.value(chosen) == 'self.client.call(Trigger.Request())'

    assert shown.check(RUNS_IF_RUN) == 'nothing judged'
    assert shown.check(CLEAN) == 'no findings'
    assert shown.check(MARKUP) == 'not checked'
    assert MARKUP in shown.text('findings')
    assert shown.page.value('document.querySelector("#findings :not(button, a)")') is None
    assert [line for line in shown.asked if 'canary' in line] == []

    deep = 'x = ' + '-' * 100_000 + '1'
    assert shown.check(deep) == 'It did not work: the text is nested too deeply for a browser'
