"""The script of the HTML page, run by a headless Chromium where there is one."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from report_samples import FINDINGS
from test_html import ARM, SOURCES

from ros2cc_extract.report.html.page import html_report

CHROMIUM = shutil.which('chromium') or shutil.which('chromium-browser')
FLAGS = (
    '--headless',
    '--no-sandbox',
    '--disable-gpu',
    '--disable-quic',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
    '--virtual-time-budget=2000',
    '--dump-dom',
)


@pytest.mark.skipif(CHROMIUM is None, reason='there is no Chromium')
def test_the_script_draws_timelines_and_arrows(tmp_path: Path) -> None:
    page = tmp_path / 'report.html'
    text = html_report([ARM], [], FINDINGS, {'files': 2}, SOURCES)
    page.write_text(text, encoding='utf-8')
    done = subprocess.run(
        [
            str(CHROMIUM),
            *FLAGS,
            f'--user-data-dir={tmp_path / "profile"}',
            f'file://{page}?theme=dark',
        ],
        capture_output=True,
        timeout=60,
        check=True,
    )
    drawn = done.stdout.decode()
    assert 'data-theme="dark"' in drawn
    assert re.findall('class="stay"[^>]*title="([^"]*)"', drawn) == [
        'tick: assigned',
        'tick: running',
        'running',
    ]
    assert 'And from step 2 on for ever.' in drawn
    assert re.search('<path d="M[^"]*" class=""', drawn)
