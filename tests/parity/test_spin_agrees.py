"""Spin, on a Promela text of its own, counts the states and transitions of the published model."""

from __future__ import annotations

from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).parents[2] / 'benchmarks'


@pytest.mark.parametrize(
    ('callbacks', 'threads', 'exclusive', 'counts'),
    [
        (1, 1, False, (57, 85)),
        (2, 2, True, (2_498, 4_416)),
        (2, 2, False, (3_454, 6_253)),
        (3, 3, True, (31_262, 64_020)),
        (4, 1, True, (25_978, 66_004)),
    ],
)
def test_spin_counts_the_published_states(
    callbacks: int,
    threads: int,
    exclusive: bool,
    counts: tuple[int, int],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    import spin_rate

    if reason := spin_rate.missing():
        pytest.skip(reason)
    run = spin_rate.run_spin(spin_rate.promela(callbacks, threads, exclusive=exclusive), 20)
    assert (run.states, run.transitions, run.complete) == (*counts, True)
