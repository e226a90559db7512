"""``confirm`` shows what ends, is destroyed, put to sleep or set to None; and never of a twin."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from interpreters import EVERY_RELEASE, interpreter_of

from ros2cc_extract.confirm.confirming import confirm
from ros2cc_extract.confirm.outcomes import Outcome
from ros2cc_extract.confirm.processes import DOMAINS_VARIABLE, release_of
from ros2cc_extract.confirm.schedules import Schedule
from tests.confirm import table
from tests.confirm.table import is_confirmed_falsely, onto, schedules
from tests.help.cases import cases
from tests.support.domains import free_domains

TESTS = Path(__file__).parents[1]
JAZZY = '7.1.6'
LIMIT_S, TWIN_S = 120.0, 8.0
AT_ONCE = 4
SHOWN_EACH_TIME = {
    'CC116 s96_node_destroyed_in_its_callback': 'no callback has begun for',
    'CC117 s88_subscriptions_destroyed_by_another_thread': 'the spin raises InvalidHandle',
    'CC305 cleared_in_use': 'another thread set goal to None after it was tested, and line 21',
}
SHOWN_AT_LEISURE = {
    'CC116 s85_shutdown_in_a_callback': 'line 16 raises RCLError',
    'CC116 s89_client_destroyed_while_called': 'line 23 waits for the answer of a client',
    'CC119 queue_of_another_loop': 'the loop sleeps for',
}


@pytest.fixture(autouse=True)
def own_domains(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    with free_domains(AT_ONCE) as numbers:
        monkeypatch.setenv(DOMAINS_VARIABLE, f'{numbers[0]}-{numbers[-1]}')
        yield


def pair_of(code: str, stem: str, folder: Path) -> tuple[Path, Path]:
    """The bad program, and its good twin: of the shapes, or as the help says."""
    bad = TESTS / 'shapes' / f'{stem}_bad.py'
    if bad.exists():
        return bad, bad.with_name(f'{stem}_good.py')
    case = next(each for each in cases() if each.code == code and stem in each.bad)
    good = folder / f'{stem}_mended.py'
    good.write_text(case.mended_text(case.mended[0]), encoding='utf-8')
    return TESTS / case.bad, good


def schedule(code: str, path: Path, release: str | None) -> Schedule | None:
    return next((each for each in schedules(path, release) if each.code == code), None)


@pytest.mark.parametrize(
    'reasons', [SHOWN_EACH_TIME, pytest.param(SHOWN_AT_LEISURE, marks=pytest.mark.slow)]
)
def test_each_is_shown_and_no_twin_is(
    reasons: dict[str, str], rclpy_python: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All in one test, several at a time: they mostly wait."""
    monkeypatch.setattr(table, 'TWIN_S', TWIN_S)
    found: dict[str, Schedule] = {}
    twins: dict[str, Schedule] = {}
    for name in reasons:
        code, stem = name.split()
        bad, good = pair_of(code, stem, tmp_path)
        of_bad = schedule(code, bad, JAZZY)
        assert of_bad is not None, name
        found[name], twins[name] = of_bad, onto(of_bad, good)
    with ThreadPoolExecutor(AT_ONCE) as pool:
        shown = {
            name: pool.submit(confirm, each, rclpy_python, LIMIT_S) for name, each in found.items()
        }
        falsely = {
            name: pool.submit(is_confirmed_falsely, each, rclpy_python)
            for name, each in twins.items()
        }
        judged = {name: each.result().judgement for name, each in shown.items()}
        assert {name: each.result() for name, each in falsely.items() if each.result()} == {}
    unlike = {
        name: judgement
        for name, judgement in judged.items()
        if judgement.outcome is not Outcome.CONFIRMED or reasons[name] not in judgement.reason
    }
    assert unlike == {}


@pytest.mark.parametrize('variable', EVERY_RELEASE)
def test_a_shutdown_that_waits_for_its_own_end_is_shown(variable: str) -> None:
    """On Humble; elsewhere it waits for nothing, and there is no finding."""
    python = interpreter_of(variable)
    bad = TESTS / 'shapes' / 's85_shutdown_in_a_callback_bad.py'
    found = schedule('CC118', bad, release_of(python))
    if found is None:
        pytest.skip('this release does not wait')
    shown = confirm(found, python, LIMIT_S).judgement
    assert (shown.outcome, 'for its own end' in shown.reason) == (Outcome.CONFIRMED, True), shown
