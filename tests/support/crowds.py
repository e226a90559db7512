"""Random networks with several instances of one template, most of them symmetric."""

from __future__ import annotations

import random

from tests.support.networks import RandomModel
from tests.support.published import document
from tests.support.small import automaton


class _Writer:
    """
    Writes workers that know themselves by ``id``, and a boss that calls them by name.

    One network in five is spoilt somewhere, so that its workers are not alike.
    """

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        self._count = self._random.randint(2, 4)
        self._is_spoilt = self._random.random() < 0.2
        self._places = self._random.randint(1, 3)
        # Whether an idle worker looks like any other, so that picking the lowest shows nothing.
        self._is_tidy = self._random.random() < 0.7

    def _pick(self, *options: str) -> str:
        return self._random.choice(options)

    def _maybe(self, share: float, text: str) -> str:
        return text if self._random.random() < share else ''

    def model(self) -> RandomModel:
        workers = ', '.join(f'w{k}' for k in range(self._count))
        system = ''.join(f'w{k} = Worker({k});\n' for k in range(self._count))
        system += 'boss = Boss();\n'
        order = self._pick(f'boss, {workers}', f'{workers}, boss', 'w0, boss, ' + workers[4:])
        templates = automaton('Worker', self._worker(), 'const Id id', 'int[0, 1] own;')
        templates += automaton('Boss', self._boss(), local='Id some;')
        text = document(self._declaration(), templates, f'{system}system {order};')
        return RandomModel(text, self._formulas())

    def _declaration(self) -> str:
        return f"""
        typedef int[0, {self._count - 1}] Id;
        chan call[Id]; {self._pick('', 'urgent ')}chan done; broadcast chan all;
        bool busy[Id]; int[0, 2] job[Id]; int[0, 2] x; Id last;
        Id lowest_idle() {{ for (t : Id) if (!busy[t]) return t; return 0; }}
        int[0, {self._count}] running() {{ return sum (t : Id) (busy[t] ? 1 : 0); }}
        """

    # -- workers -------------------------------------------------------------------------
    def _worker(self) -> str:
        marks = ['', '', 'U:', 'C:']
        head = ' '.join(f'{self._pick(*marks) if i else ""}l{i}' for i in range(self._places + 1))
        edges = ['l0 -> l1; sync: call[id]?; do: busy[id] = true']
        for place in range(1, self._places + 1):
            edges.append(self._work(place, (place + 1) % (self._places + 1)))
        edges += [
            self._work(self._random.randint(int(self._is_tidy), self._places), 0)
            for _ in range(self._random.randint(0, 2))
        ]
        if self._is_spoilt:
            edges.append(self._spoilt())
        return '\n'.join([head, *edges])

    def _work(self, source: int, target: int) -> str:
        edge = f'l{source} -> l{target}'
        if self._random.random() < 0.4:
            edge += '; guard: ' + self._pick(
                'x != 1', 'own == 0', 'running() > 1', 'job[id] > 0', 'last == id',
                'exists (t : Id) t != id && busy[t]', 'last != id',
            )  # fmt: skip
        edge += self._maybe(0.5, f'; sync: {self._pick("done!", "all?", "all!", "done?")}')
        ends = 'busy[id] = true' if target else 'busy[id] = false'
        others = self._pick(
            'own = 1 - own', 'x = (x + 1) % 3', 'x = own', 'job[id] = 0', 'last = id',
            'job[id] = x', 'own = last == id ? 1 : 0',
        )  # fmt: skip
        do = self._pick(ends, others, f'{ends}, {others}', f'{others}, {ends}')
        if self._is_tidy and not target:
            do = f'{others}, busy[id] = false, own = 0, job[id] = 0'
        return f'{edge}; do: {do}'

    def _spoilt(self) -> str:
        return self._pick(
            'l0 -> l0; guard: id == 0 && x == 1; do: x = 2',
            'l1 -> l0; guard: id > 0',
            'l0 -> l1; guard: busy[0] && id != 0',
            'l1 -> l1; do: x = id % 3',
            'l1 -> l0; guard: last < id; do: busy[id] = false',
            'l0 -> l0; sync: all?; do: x = job[id]',
        )

    # -- the boss ------------------------------------------------------------------------
    def _boss(self) -> str:
        head = 'b0 ' + self._pick('U:b1', 'C:b1', 'b1') + ' b2'
        give = self._pick('job[some] = x', 'job[some] = 2', 'busy[some] = true, job[some] = 1')
        called = [
            'b0 -> b1; guard: exists (t : Id) !busy[t]; do: some = lowest_idle()',
            f'b1 -> b0; sync: call[some]!; do: {give}',
        ]
        picked = ['b0 -> b0; sync: call[lowest_idle()]!; do: job[lowest_idle()] = x']
        selected = ['b0 -> b1; select: t : Id; guard: !busy[t]; sync: call[t]!; do: job[t] = x',
                    'b1 -> b0']  # fmt: skip
        edges = list(self._random.choice([called, picked, selected, selected]))
        edges.append('b0 -> b2; sync: ' + self._pick('done?', 'all?', 'all!'))
        edges.append(f'b2 -> b0; do: {self._pick("x = 0", "x = running() % 3", "x = 1")}')
        if self._random.random() < 0.2:
            edges.append('b2 -> b0; do: some = last')
        return '\n'.join([head, *edges])

    # -- queries -------------------------------------------------------------------------
    def _atom(self) -> str:
        everybody = ' || '.join(f'w{k}.l1' for k in range(self._count))
        atom = self._pick(
            'x == 1', 'boss.b1', 'running() == 2', 'exists (t : Id) busy[t] && job[t] == 1',
            'forall (t : Id) busy[t]', f'({everybody})', 'deadlock', 'sum (t : Id) job[t] > 2',
            'exists (t : Id) exists (u : Id) t != u && busy[t] && job[u] == 2',
        )  # fmt: skip
        return (
            self._pick(f'w{self._count - 1}.own == 1', 'busy[0]')
            if (self._random.random() < 0.03)
            else atom
        )

    def _formulas(self) -> tuple[str, ...]:
        def formula() -> str:
            left, right = self._atom(), self._atom()
            return self._pick(left, f'not ({left})', f'{left} and not ({right})')

        return (
            'A[] not deadlock',
            *(f'E<> {formula()}' for _ in range(2)),
            *(f'A[] {formula()}' for _ in range(2)),
            f'A<> {formula()}',
            f'E[] {formula()}',
            *(f'({formula()}) --> ({formula()})' for _ in range(2)),
        )


def random_crowd(seed: int) -> RandomModel:
    """Return the model of a seed; the same for the same seed."""
    return _Writer(seed).model()
