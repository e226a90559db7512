"""Well-known protocols as models, with their known answers; nothing of ours in them."""

from __future__ import annotations

from ros2cc_extract.checker.api import Model
from tests.support.small import automaton, network


def peterson() -> Model:
    """Peterson's mutual exclusion for two processes."""
    process = automaton(
        'Process',
        """idle asking waiting critical
        idle -> asking; do: wants[me] = true
        asking -> waiting; do: turn = 1 - me
        waiting -> critical; guard: !wants[1 - me] || turn == me
        critical -> idle; do: wants[me] = false""",
        parameters='const int[0, 1] me',
    )
    return network(
        process,
        declaration='bool wants[2]; int[0, 1] turn;',
        system='P0 = Process(0); P1 = Process(1); system P0, P1;',
    )


def broken_lock() -> Model:
    """Two processes that look at a flag and set it in a second step."""
    process = automaton(
        'Process',
        """idle sees critical
        idle -> sees; guard: !taken
        sees -> critical; do: taken = true
        critical -> idle; do: taken = false""",
    )
    return network(
        process,
        declaration='bool taken;',
        system='P0 = Process(); P1 = Process(); system P0, P1;',
    )


def philosophers(count: int, *, one_left_handed: bool) -> Model:
    """Dining philosophers who keep the first fork while they wait for the second."""
    philosopher = automaton(
        'Philosopher',
        """thinking has_one eating
        thinking -> has_one; guard: !fork[first]; do: fork[first] = true
        has_one -> eating; guard: !fork[second]; do: fork[second] = true
        eating -> thinking; do: fork[first] = false, fork[second] = false""",
        parameters='const id_t id',
        local=f'const id_t left = id; const id_t right = (id + 1) % N;'
        f' const bool swaps = {"id == 0" if one_left_handed else "false"};'
        ' const id_t first = swaps ? right : left;'
        ' const id_t second = swaps ? left : right;',
    )
    return network(
        philosopher,
        declaration=f'const int N = {count}; typedef int[0, N - 1] id_t; bool fork[N];',
        system='system Philosopher;',
    )


def bounded_buffer(size: int) -> Model:
    """Producers and a consumer around a ring of ``size`` cells that carry sequence numbers."""
    producer = automaton(
        'Producer',
        """ready
        ready -> ready; guard: used < SIZE; do: put(next), next = (next + 1) % 4""",
        local='int[0, 3] next;',
    )
    consumer = automaton(
        'Consumer',
        """ready checking error
        ready -> checking; guard: used > 0; do: got = take()
        checking -> ready; guard: got == expected; do: expected = (expected + 1) % 4, got = 0
        checking -> error; guard: got != expected""",
        local='int[0, 3] got, expected;',
    )
    declaration = f"""
        const int SIZE = {size};
        int[0, 3] cell[SIZE];
        int[0, SIZE] used;
        int[0, SIZE - 1] head;
        void put(int value) {{ cell[(head + used) % SIZE] = value; used++; }}
        int take() {{
            int value = cell[head];
            cell[head] = 0;
            head = (head + 1) % SIZE;
            used--;
            return value;
        }}
    """
    return network(
        producer, consumer, declaration=declaration, system='system Producer, Consumer;'
    )
