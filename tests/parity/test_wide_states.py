"""States of more than one word, and of hundreds of variables, on both engines."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import EngineKind
from tests.support.small import ask, automaton, network

pytest.importorskip('ros2cc_extract.checker._core', reason='the native core is not built')


@pytest.mark.parametrize('cells', [1, 3, 9, 40])
@pytest.mark.parametrize('low', [-32768, 0])
def test_wide_states_agree(cells: int, low: int) -> None:
    walker = automaton(
        'W',
        'a U:b\na -> b; guard: at < N; do: cell[2 * at + start] = at * 7 + start, at++\n'
        'b -> a; do: flip()',
        parameters='const int[0, 1] start',
        local='int[0, N] at;',
    )
    declaration = f"""
        const int N = {cells};
        int[{low}, 32767] cell[2 * N];
        bool odd[N + 1];
        void flip() {{ int k; for (k = 0; k <= N; k++) odd[k] = !odd[k]; }}
    """
    model = network(walker, declaration=declaration, system='system W;')
    formulas = (
        'A[] not deadlock',
        f'E<> cell[{2 * cells - 1}] == {(cells - 1) * 7 + 1} and odd[{cells}]',
        'A[] forall (k : int[0, 2 * N - 1]) cell[k] <= k / 2 * 7 + 1',
        'W(0).b --> W(0).a',
        'W(0).at == 0 --> W(0).at == 1',
    )
    results = [
        ask(model, *formulas, engine=engine, reduction=False)
        for engine in (EngineKind.NATIVE, EngineKind.REFERENCE)
    ]
    native, slow = (
        (r.states, r.transitions, [a.verdict.value for a in r.answers]) for r in results
    )
    assert native == slow
    assert native[2] == [
        'not satisfied', 'satisfied', 'satisfied', 'satisfied', 'not satisfied',
    ]  # fmt: skip
