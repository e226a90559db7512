"""Findings that hang on defaults of parameters say so, and name the setting that leads there."""

from __future__ import annotations

from dataclasses import replace

from finding_units import ONE_THREAD, at, calls, client, only, timer, unit

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark

SETTING = "self.waits holds, which it does not by default: parameter 'waits' (default False)"
PERIOD = "period follows from parameter 'period' (default 0.5)"
THREADS = "number of threads follows from parameter 'threads' (default 1)"


def test_a_wait_to_which_no_default_leads_is_a_warning_with_its_condition() -> None:
    waiting = timer('tick', blocking=calls('plan_client', only_if=SETTING))
    finding = only(unit(ONE_THREAD, waiting, client('plan_client')), 'CC102')
    assert finding.severity is Severity.WARNING
    assert finding.message.endswith(f'it waits forever; only if {SETTING}')


def test_what_is_reached_on_other_ways_too_stays_an_error() -> None:
    ways = (*calls('plan_client', only_if=SETTING), *calls('plan_client', chain=(at(39),)))
    waiting = timer('tick', blocking=ways)
    finding = only(unit(ONE_THREAD, waiting, client('plan_client')), 'CC102')
    assert (finding.severity, SETTING in finding.message) == (Severity.ERROR, False)


def test_what_was_assumed_of_its_callbacks_and_threads_is_shown() -> None:
    waiting = timer('tick', blocking=calls('plan_client'), assumed=PERIOD, source=at(7))
    one = replace(ONE_THREAD, assumed=THREADS, source=at(90))
    finding = only(unit(one, waiting, client('plan_client')), 'CC102')
    assert finding.related[-2:] == (
        Remark(at(7), f'assumed: {PERIOD}'),
        Remark(at(90), f'assumed: {THREADS}'),
    )
