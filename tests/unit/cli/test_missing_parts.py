"""What the command line says where a native part is not there."""

from __future__ import annotations

import io
import sys
from argparse import Namespace
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main
from ros2cc_extract.cli.shared.native_parts import CORE, JOURNAL, MEND, report_missing_parts
from ros2cc_extract.extract.live.recorder import journal

NODE = Path(__file__).parents[3] / 'launch_free_examples/two_groups/node.py'


def told(name: str, **given: object) -> str:
    stderr = io.StringIO()
    report_missing_parts(name, Namespace(**given), stderr)
    return stderr.getvalue()


@pytest.fixture
def nothing_native(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('ROS2CC_LIVE_NATIVE', raising=False)
    for module in (CORE, JOURNAL):
        monkeypatch.setitem(sys.modules, module, None)


@pytest.mark.usefixtures('nothing_native')
def test_a_check_says_what_the_plain_checker_costs() -> None:
    assert told('check', engine='auto') == (
        'ros2cc-extract: note: the native core of the checker is not built, or does not load here '
        '(import of ros2cc_extract.checker._core halted; None in sys.modules): a check takes some '
        f'twenty times as long, and large units stay undecided; {MEND}\n'
    )


@pytest.mark.usefixtures('nothing_native')
def test_the_hook_says_what_the_plain_journal_costs() -> None:
    assert 'the native journal of the hook is not built' in told('run')
    assert told('run').count('\n') == told('attach').count('\n') == told('env').count('\n') == 1


@pytest.mark.usefixtures('nothing_native')
def test_nothing_is_said_to_who_asked_for_python_or_uses_neither(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv('ROS2CC_LIVE_NATIVE', '0')
    assert told('check', engine='reference') + told('spec') + told('run') == ''


@pytest.mark.usefixtures('nothing_native')
def test_it_is_said_once_for_many_units() -> None:
    stdout, stderr = io.StringIO(), io.StringIO()
    # What the native core has found out before is no worse.
    main(
        ['--no-cache', '--verdicts', str(NODE), str(NODE.parents[1] / 'two_nodes_one_executor')],
        stdout,
        stderr,
    )
    assert (stdout.getvalue() + stderr.getvalue()).count('not built') == 1
    assert 'reference checker' in stdout.getvalue()


def test_a_journal_of_an_older_text_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip(JOURNAL, reason='the native parts are not built')
    monkeypatch.delenv('ROS2CC_LIVE_NATIVE', raising=False)
    monkeypatch.setattr(journal, 'native', None)
    assert '(it was built of an older text)' in told('run')


def test_nothing_is_said_where_both_are_there() -> None:
    for module in (CORE, JOURNAL):
        pytest.importorskip(module, reason='the native parts are not built')
    if journal.native is None:
        pytest.skip('the journal is of an older text')
    assert told('check', engine='auto') + told('run') == ''
