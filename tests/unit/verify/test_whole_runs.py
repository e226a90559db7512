"""Runs as JSON: each step that was taken stands in them, also one without words."""

from __future__ import annotations

from ros2cc_extract.checker.api import Query, check, read_model
from ros2cc_extract.generator.build import Profile, Text, render
from ros2cc_extract.report.machine.json_report import evidence_data
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    Executor,
    GroupType,
    Spec,
)
from ros2cc_extract.verify.results.run_evidence import Names, describe
from tests.support.published import document
from tests.support.small import automaton

UNIT = close(
    Spec(
        name='unit',
        callbacks=tuple(
            Callback(name=name, type=CallbackType.SUB, group='g') for name in ('scan', 'stop')
        ),
        groups=(CallbackGroup(name='g', type=GroupType.REENTRANT),),
        executor=Executor(name='executor', kind='SingleThreadedExecutor', threads=('one',)),
    )
)


def test_every_step_of_a_run_is_written() -> None:
    """The executor's own steps have no words, and the last one is such a step."""
    model = read_model(render(UNIT, profile=Profile.RCLPY, text=Text.PLAIN).xml, 'unit.xml')
    query = Query('E<> (cb_running(1) and cb_waiting[0] == 0)', '', None)
    (answer,) = check(model, [query]).answers
    assert answer.path is not None
    evidence = describe(answer.path, Names.of(UNIT.spec))
    written = evidence_data(evidence)
    assert [step['step'] for step in written] == list(range(1, len(answer.path.steps) + 1))
    assert [step['edges'] for step in written] == [
        [f'{edge.process}: {edge.source} -> {edge.target}' for edge in step.edges]
        for step in answer.path.steps
    ]
    silent = [step for step in written if not step['text']]
    assert silent
    assert len(written) == len(evidence.moments) + len(silent)
    changes: dict[str, object] = {}
    for step in written:
        changes |= step['changes']
    last = answer.path.steps[-1].state
    assert {
        name: last.variables.get(name, last.locations.get(name)) for name in changes
    } == changes


def test_a_run_that_ends_in_a_step_without_words_is_written_to_its_end() -> None:
    model = read_model(
        document('bool b;', automaton('P', 'a c\na -> c; do: b = true'), 'system P;'), 'm.xml'
    )
    (answer,) = check(model, [Query('E<> P.c', '', None)]).answers
    assert answer.path is not None
    assert [step['edges'] for step in evidence_data(describe(answer.path, Names()))] == [
        ['P: a -> c']
    ]
