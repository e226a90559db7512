"""Random programs lose nothing: rclpy keeps ten requests of a service, and drops the oldest."""

from __future__ import annotations

from tests.conformance.programs import (
    CLIENT,
    REQUESTS_KEPT,
    SERVICE,
    SPINS_AT_A_TIME,
    SPINS_FIRST,
    Program,
    draw,
    server_of,
)

#: Its callbacks spin for answers of a service that others asked five times meanwhile.
SPINS_FOR_ITS_OWN_SERVICE = SPINS_FIRST + 55


def asked_from_outside(program: Program) -> dict[int, int]:
    numbers = [number for _, number in program.feeds]
    services = (e.number for e in program.entities if e.kind == SERVICE)
    return {number: numbers.count(number) for number in services}


def test_requests_from_outside_leave_room_for_those_of_callbacks_that_spin() -> None:
    program = draw(SPINS_FOR_ITS_OWN_SERVICE)
    (client,) = (e for e in program.entities if e.kind == CLIENT)
    server = server_of(program, client)
    assert server is not None
    left = REQUESTS_KEPT - SPINS_AT_A_TIME
    assert asked_from_outside(program) == {server.number: left}


def test_nobody_publishes_requests_in_a_program_that_spins() -> None:
    for seed in range(SPINS_FIRST + 420, SPINS_FIRST + 430):
        program = draw(seed)
        fed = [d.on for e in program.entities for d in e.effects if d.what == 'publish']
        assert all(program.entities[number].kind != SERVICE for number in fed)
