"""Callbacks that may take all threads while they wait: who never ends then, and who starves."""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.slices import narrowing
from ros2cc_extract.verify.unit import verify_unit

SLICED = Options(profile=Profile.RCLPY, structural=False, limits=Limits(seconds=120))


def crowded(callers: int, threads: int, others: int = 1) -> ClosedSpec:
    """Timers that call somebody outside, each in its own group as its client is, and others."""

    def callback(name: str, kind: EntityKind, calls: str = '') -> Callback:
        return Callback(
            name=name,
            type=kind.published_type,
            entity=kind,
            group=f'of_{name}',
            node='crowd',
            key=name,
            blocking=(Blocking(call='client.call', on=calls),) if calls else (),
        )

    callbacks = [
        *(callback(f'ask_{n}', EntityKind.TIMER, f'answer_{n}') for n in range(callers)),
        *(callback(f'answer_{n}', EntityKind.CLIENT) for n in range(callers)),
        *(callback(f'other_{n}', EntityKind.SUBSCRIPTION) for n in range(others)),
    ]
    return close(
        Spec(
            name='crowd',
            callbacks=tuple(callbacks),
            groups=tuple(CallbackGroup(name=c.group, type=GroupType.EXCLUSIVE) for c in callbacks),
            executor=Executor(
                name='executor',
                kind='MultiThreadedExecutor',
                threads=tuple(f'thread_{n}' for n in range(threads)),
            ),
        )
    )


def verdicts(found: Verification) -> dict[tuple[str | None, tuple[str, ...]], Verdict]:
    return {(r.family, r.callbacks): r.verdict for r in found.results}


def test_a_large_unit_whose_threads_may_all_be_taken_is_decided() -> None:
    found = verify_unit(crowded(callers=9, threads=6, others=20), SLICED)
    assert not [r.words for r in found.results if r.verdict is Verdict.UNDECIDED]
    of = verdicts(found)
    assert of['deadlock', ()] is Verdict.NOT_SATISFIED
    for name in ('ask_0', 'ask_8'):
        assert of['progress', (name,)] is Verdict.NOT_SATISFIED
    for name in ('ask_0', 'ask_8', 'answer_3', 'other_19'):
        assert of['starvation', (name,)] is Verdict.NOT_SATISFIED


def test_whoever_starves_beside_a_crowd_has_a_run_of_his_own() -> None:
    found = verify_unit(crowded(callers=5, threads=4, others=9), SLICED)
    starving = next(
        r for r in found.results if r.family == 'starvation' and r.callbacks == ('other_8',)
    )
    assert starving.evidence is not None
    said = [s.text for moment in starving.evidence.moments for s in moment.sentences]
    assert any('other_8' in text for text in said)


def test_crowds_say_what_the_whole_unit_says() -> None:
    small, narrowing.SMALL = narrowing.SMALL, 0
    try:
        for callers, threads in ((2, 2), (3, 2), (2, 3)):
            unit = crowded(callers, threads)
            whole = verify_unit(unit, replace(SLICED, limits=Limits(states=3_000_000)))
            assert verdicts(verify_unit(unit, SLICED)) == verdicts(whole)
    finally:
        narrowing.SMALL = small


def test_runs_of_its_own_do_not_make_a_callback_starve() -> None:
    """Alone in filling the threads: who starves does not run, so nothing is asked twice."""
    closed = crowded(callers=1, threads=8, others=9)
    groups = (
        replace(g, type=GroupType.REENTRANT) if g.name == 'of_ask_0' else g
        for g in closed.spec.groups
    )
    found = verify_unit(replace(closed, spec=replace(closed.spec, groups=tuple(groups))), SLICED)
    assert not [r.words for r in found.results if r.verdict is Verdict.UNDECIDED]
    assert found.states < 20_000
    of = verdicts(found)
    assert of['starvation', ('ask_0',)] is Verdict.SATISFIED
    assert of['starvation', ('other_8',)] is Verdict.NOT_SATISFIED
