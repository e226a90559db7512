"""Demands of a project, decided on verdicts."""

from __future__ import annotations

from dataclasses import replace

import pytest
from finding_units import at, exclusive, subscription, threads, timer, unit

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.errors import InputError
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.requirements import check_requirements, read_requirements
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import EntityKind
from ros2cc_extract.verify.results.evidence import Evidence
from ros2cc_extract.verify.results.results import QueryResult, Verification

TABLE = Place('pyproject.toml', 12)
RUN = Evidence(start={}, moments=(), cycle_from=None, ends=None)
ARM = unit(
    threads(2),
    timer('move', defined=at(20)),
    subscription('stop', 'other', function='node.Arm.on_stop', defined=at(30)),
)


def verdicts(*results: tuple[str, tuple[str, ...], Verdict]) -> Verification:
    return Verification(
        model='arm',
        profile='paper',
        text='plain',
        engine='reference',
        states=1,
        transitions=1,
        seconds=0.0,
        peak_mb=1.0,
        complete=True,
        results=tuple(
            QueryResult(
                family=family,
                formula='',
                words='',
                callbacks=callbacks,
                verdict=verdict,
                reason='20 s' if verdict is Verdict.UNDECIDED else None,
                seconds=0.0,
                run=RUN if verdict is Verdict.NOT_SATISFIED else None,
            )
            for family, callbacks, verdict in results
        ),
    )


def check(table: dict[str, object], verdict: Verdict) -> tuple[Finding, ...]:
    pair = ('move', 'stop')
    verification = verdicts(
        ('never_together', pair, verdict),
        ('can_overlap', pair, verdict),
        ('starvation', ('stop',), verdict),
    )
    return check_requirements(read_requirements(table, TABLE), [ARM], [verification])


def test_an_action_server_is_meant_by_its_function_too() -> None:
    server = EntityKind.ACTION_SERVER
    stop = replace(ARM.callbacks[1], entity=server, function='node.Arm.on_goal')
    served = replace(ARM, callbacks=(ARM.callbacks[0], stop))
    table = read_requirements({'never_starves': ['on_goal']}, TABLE)
    asked = verdicts(('starvation', ('stop',), Verdict.SATISFIED))
    assert check_requirements(table, [served], [asked]) == ()


@pytest.mark.parametrize(
    'table',
    [
        {'never_together': [['on_stop', 'move']]},
        {'can_overlap': [['stop', 'move']]},
        {'never_starves': ['node.Arm.on_stop']},
    ],
)
def test_the_verdict_decides(table: dict[str, object]) -> None:
    assert check(table, Verdict.SATISFIED) == ()
    (violated,) = check(table, Verdict.NOT_SATISFIED)
    assert (violated.code, violated.severity, violated.run) == ('CC601', Severity.ERROR, RUN)
    (open_one,) = check(table, Verdict.UNDECIDED)
    assert (open_one.code, open_one.severity) == ('CC603', Severity.WARNING)


def test_what_was_not_asked_stays_undecided_and_says_so() -> None:
    requirements = read_requirements({'never_starves': ['on_stop']}, TABLE)
    (finding,) = check_requirements(requirements, [ARM], [verdicts()])
    assert finding.code == 'CC603'
    assert finding.message.endswith('is undecided: the query was not asked')


def test_a_violation_stands_at_the_callback() -> None:
    (finding,) = check({'never_together': [['on_stop', 'move']]}, Verdict.NOT_SATISFIED)
    assert finding.place == at(30)
    assert finding.message == (
        'required: on_stop and move never run at the same time; that does not hold'
    )
    assert [remark.place for remark in finding.related] == [at(20)]


def test_a_name_that_is_no_callback_is_told() -> None:
    (finding,) = check({'never_starves': ['on_stopp']}, Verdict.SATISFIED)
    assert (finding.code, finding.place) == ('CC602', TABLE)
    assert "there is no callback 'on_stopp'" in finding.message


def test_one_callback_by_two_names_is_no_pair() -> None:
    assert check({'never_together': [['stop', 'on_stop']]}, Verdict.NOT_SATISFIED) == ()


def test_different_executors_keep_nothing_apart() -> None:
    leg = replace(unit(threads(2), timer('walk', 'g'), groups=(exclusive('g'),)), name='leg')
    required = read_requirements({'never_together': [['move', 'walk']]}, TABLE)
    (finding,) = check_requirements(required, [ARM, leg], [verdicts(), verdicts()])
    assert finding.code == 'CC601'
    assert '(move by unit arm, walk by unit leg)' in finding.message
    overlap = read_requirements({'can_overlap': [['move', 'walk']]}, TABLE)
    assert check_requirements(overlap, [ARM, leg], [verdicts(), verdicts()]) == ()


@pytest.mark.parametrize(
    'table',
    [
        {'never_together': ['a', 'b']},
        {'never_together': [['a', 'b', 'c']]},
        {'never_starves': 'a'},
        {'can_overlap': [['a', 1]]},
    ],
)
def test_a_malformed_demand_is_refused(table: dict[str, object]) -> None:
    with pytest.raises(InputError, match=r'pyproject.toml:12: \w+ is not a list of callback'):
        read_requirements(table, TABLE)


def test_other_keys_of_the_table_are_left_alone() -> None:
    assert read_requirements({'baseline': 'x.json'}, TABLE) == ()
