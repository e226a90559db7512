"""
Random node programs: what each is made of, drawn from a seed.

Standard library only: the same description is built into real nodes by ``driver.py`` and into
a specification by ``units.py``.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from random import Random
from typing import Any

SINGLE, MULTI, EVENTS = 'SingleThreadedExecutor', 'MultiThreadedExecutor', 'EventsExecutor'
TIMER, SUBSCRIPTION, GUARD = 'timer', 'subscription', 'guard_condition'
SERVICE, CLIENT, TASK = 'service', 'client', 'task'
#: One program of so many runs on the executor written in C++, of which less can be recorded.
EVENTS_EVERY = 10
#: From this seed on, all programs run on that executor, and say what arrives.
EVENTS_FIRST = 10_000_000
#: From this seed on callbacks spin their executor for the answers of clients.
SPINS_FIRST = 20_000_000
#: What rclpy keeps of requests that nobody took, and of messages in such a program.
REQUESTS_KEPT, MESSAGES_KEPT = 10, 200
#: How many callbacks spin for answers at a time, at most; so many requests of others are kept too.
SPINS_AT_A_TIME = 8
#: What runs as a callback that somebody wrote; a client has none.
WRITTEN = (TIMER, SUBSCRIPTION, GUARD, SERVICE)


@dataclass(frozen=True)
class Effect:
    """
    What a callback does besides working.

    :param what: call (hold the thread until the client has its answer), await_call, wait (hold
        the thread until the other has run), await_other, make_task, publish, spin_call (spin the
        executor until the client has its answer).
    :param on: number of the client, the other callback or the task.
    """

    what: str
    on: int


@dataclass(frozen=True)
class Entity:
    """
    One callback, client or task.

    :param group: number of its group; of its node's groups.
    :param period_s: of a timer.
    :param work_s: how long it sleeps, which frees the interpreter as real work does not.
    :param spin_s: how long it keeps the interpreter busy.
    :param key: topic or service.
    """

    number: int
    kind: str
    node: int
    group: int
    period_s: float
    work_s: float
    spin_s: float
    key: str
    effects: tuple[Effect, ...]

    @property
    def name(self) -> str:
        return f'c{self.number}'


@dataclass(frozen=True)
class Group:
    node: int
    reentrant: bool


@dataclass(frozen=True)
class Program:
    """
    A node program.

    :param feeds: what arrives from outside: pause in seconds, then number of the entity.
    :param tells_arrivals: all that arrives for subscriptions and services is reported, and kept.
    """

    seed: int
    executor: str
    threads: int
    nodes: int
    groups: tuple[Group, ...]
    entities: tuple[Entity, ...]
    feeds: tuple[tuple[float, int], ...]
    tells_arrivals: bool = False

    def node_name(self, node: int) -> str:
        return f'p{label(self.seed)}_n{node}'


def draw(seed: int) -> Program:
    """Draw one program; the same for the same seed. Below 0 they are written by hand."""
    if seed < 0:
        return WRITTEN_BY_HAND[-seed - 1](seed)
    random = Random(seed)
    executor = random.choice((SINGLE, MULTI, MULTI, MULTI))
    tells_arrivals, spins = EVENTS_FIRST <= seed < SPINS_FIRST, seed >= SPINS_FIRST
    if tells_arrivals or (seed % EVENTS_EVERY == EVENTS_EVERY - 2 and not spins):
        executor = EVENTS
    if spins:
        executor = SINGLE  # threads that spin one pool break each other's laps (docs/conform.md)
    nodes = random.choice((1, 1, 1, 2, 3))
    groups = [Group(n, random.random() < 0.3) for n in range(nodes)]
    for _ in range(random.randint(0, 3)):
        groups.append(Group(random.randrange(nodes), random.random() < 0.3))
    kinds = _draw_kinds(random, executor)
    if spins:
        kinds = [kind for kind in kinds if kind != CLIENT] + [CLIENT]
    entities = [_draw_entity(random, seed, n, kind, groups) for n, kind in enumerate(kinds)]
    entities = [_with_effects(random, entity, entities, executor) for entity in entities]
    if tells_arrivals or spins:
        entities = [_without_requests(entity, entities) for entity in entities]
    if spins:
        entities = [_spinning(entity) for entity in entities]
    fed = [e.number for e in entities if e.kind in (SUBSCRIPTION, GUARD, SERVICE)]
    program = Program(
        seed=seed,
        executor=executor,
        threads=1 if executor != MULTI else random.randint(1, 6),
        nodes=nodes,
        groups=tuple(groups),
        entities=tuple(entities),
        feeds=_draw_feeds(random, fed),
        tells_arrivals=tells_arrivals,
    )
    if tells_arrivals or spins:
        return replace(program, feeds=_kept(program))
    return program


def _draw_kinds(random: Random, executor: str) -> list[str]:
    written = [TIMER, TIMER, SUBSCRIPTION, SUBSCRIPTION, SUBSCRIPTION, SERVICE]
    if executor != EVENTS:
        written.append(GUARD)
    kinds = [random.choice(written) for _ in range(random.randint(1, 6))]
    if executor == EVENTS:
        return kinds
    if random.random() < 0.4:
        kinds.append(CLIENT)
    if random.random() < 0.3:
        kinds += [TASK] * random.randint(1, 2)
    return kinds


def _draw_entity(random: Random, seed: int, number: int, kind: str, groups: list[Group]) -> Entity:
    group = random.randrange(len(groups))
    return Entity(
        number=number,
        kind=kind,
        node=groups[group].node,
        group=group,
        period_s=random.choice((0.005, 0.01, 0.02, 0.04)),
        work_s=random.choice((0.0, 0.0, 0.001, 0.004, 0.012)),
        spin_s=random.choice((0.0, 0.0, 0.0, 0.001, 0.003)),
        key=f'p{label(seed)}_k{number}',
        effects=(),
    )


def _with_effects(random: Random, entity: Entity, entities: list[Entity], executor: str) -> Entity:
    """Give some callbacks something to do; each client and task is used by one callback."""
    if entity.kind not in (TIMER, SUBSCRIPTION, SERVICE):
        return entity
    mine = [e for e in entities if e.kind in WRITTEN]
    owners = [e for e in mine if e.kind in (TIMER, SUBSCRIPTION, SERVICE)]
    effects = []
    for other in entities:
        if other.kind in (CLIENT, TASK) and owners[other.number % len(owners)] is entity:
            effects.append(Effect(_use_of(Random(other.key), other), other.number))
    others = [e for e in mine if e.number != entity.number]
    if not effects and others and random.random() < 0.2:
        what = random.choice(('wait', 'await_other', 'publish'))
        if executor == EVENTS and what == 'await_other':
            what = 'publish'  # rclpy's EventsExecutor knows no coroutines (CC113)
        effects.append(Effect(what, random.choice(others).number))
    return Entity(**{**vars(entity), 'effects': tuple(effects)})


def _spinning(entity: Entity) -> Entity:
    """The same, where a nested spin stands for each call."""
    effects = (
        replace(effect, what='spin_call') if effect.what in ('call', 'await_call') else effect
        for effect in entity.effects
    )
    return replace(entity, effects=tuple(effects))


def _use_of(random: Random, other: Entity) -> str:
    return 'make_task' if other.kind == TASK else random.choice(('call', 'await_call'))


def server_of(program: Program, client: Entity) -> Entity | None:
    """The service of the program that a client calls; ``None`` for one of somebody else."""
    services = [e for e in program.entities if e.kind == SERVICE]
    asked = client.number % (len(services) + 1)
    return services[asked] if asked < len(services) else None


def _draw_feeds(random: Random, fed: list[int]) -> tuple[tuple[float, int], ...]:
    feeds = []
    total = 0.0
    while total < 0.2:
        pause = random.choice((0.0, 0.0, 0.001, 0.004, 0.02))
        total += pause + 0.0005
        if fed:
            feeds.append((pause, random.choice(fed)))
        else:
            feeds.append((0.02, -1))
            total += 0.02
    return tuple(feeds)


def _without_requests(entity: Entity, entities: list[Entity]) -> Entity:
    """Nobody counts the requests that callbacks make."""
    effects = (d for d in entity.effects if d.what != 'publish' or entities[d.on].kind != SERVICE)
    return replace(entity, effects=tuple(effects))


def _kept(program: Program) -> tuple[tuple[float, int], ...]:
    """
    Ask no service more often than its queue is long, however slow it is.

    Where callbacks spin for answers of a service their requests have most of the room.
    """
    room = {e.number: REQUESTS_KEPT for e in program.entities if e.kind == SERVICE}
    for client in program.entities:
        server = server_of(program, client) if client.kind == CLIENT else None
        if server is not None:
            room[server.number] = REQUESTS_KEPT - SPINS_AT_A_TIME
    asked: Counter[int] = Counter()
    kept = []
    for pause, number in program.feeds:
        asked[number] += 1
        is_lost = asked[number] > room.get(number, asked[number])
        kept.append((pause, -1 if is_lost else number))
    return tuple(kept)


def label(seed: int) -> str:
    """A seed as part of a ROS name."""
    return str(seed).replace('-', 'm')


def _busy_group_with_client_and_service(seed: int) -> Program:
    """A client and a service become ready while their group is closed, and are found together."""
    groups = (Group(0, False), Group(0, True))
    entities = (
        _entity(seed, 0, TIMER, 0, period_s=0.02, work_s=0.012),
        _entity(seed, 1, SERVICE, 0),
        _entity(seed, 2, CLIENT, 0),
        _entity(seed, 3, TIMER, 1, period_s=0.01, effects=(Effect('await_call', 2),)),
    )
    # The client (number 2) asks the service of somebody else: see ``server_of``.
    return _by_hand(seed, 3, groups, (*entities, _entity(seed, 4, SERVICE, 1)), (1,) * 30)


def _rivals(seed: int) -> Program:
    """Members of one exclusive group are queued together, and most starts are refused."""
    groups = (Group(0, False),)
    entities = (
        _entity(seed, 0, TIMER, 0, period_s=0.01, work_s=0.004),
        _entity(seed, 1, SUBSCRIPTION, 0, work_s=0.004),
        _entity(seed, 2, SUBSCRIPTION, 0, work_s=0.004),
    )
    return _by_hand(seed, 2, groups, entities, (1, 2) * 12)


def _busy_pool(seed: int) -> Program:
    """Callbacks are collected while the only worker is busy."""
    groups = (Group(0, True),)
    entities = (
        _entity(seed, 0, SUBSCRIPTION, 0, work_s=0.008),
        _entity(seed, 1, SUBSCRIPTION, 0, work_s=0.008),
        _entity(seed, 2, TIMER, 0, period_s=0.02, work_s=0.001),
    )
    return _by_hand(seed, 1, groups, entities, (0, 1) * 8)


def _two_tasks(seed: int) -> Program:
    """Both tasks are made before either is served."""
    entities = (
        _entity(seed, 0, TIMER, 0, effects=(Effect('make_task', 1), Effect('make_task', 2))),
        _entity(seed, 1, TASK, 0),
        _entity(seed, 2, TASK, 0),
        _entity(seed, 3, SUBSCRIPTION, 0),
    )
    program = _by_hand(seed, 1, (Group(0, False),), entities, (3,) * 40)
    return replace(program, executor=SINGLE)


def _arrivals_while_busy(seed: int) -> Program:
    """A callback that runs makes two messages arrive after a request, and one of them again."""
    fed = tuple(Effect('publish', number) for number in (2, 3, 4, 3))
    entities = (
        _entity(seed, 0, SUBSCRIPTION, 0, effects=fed),
        _entity(seed, 1, TIMER, 0, work_s=0.001),
        _entity(seed, 2, SERVICE, 0),
        _entity(seed, 3, SUBSCRIPTION, 0),
        _entity(seed, 4, SUBSCRIPTION, 0),
    )
    program = _by_hand(seed, 1, (Group(0, False),), entities, (0,) * 2)
    return replace(program, executor=EVENTS, tells_arrivals=True)


def _entity(seed: int, number: int, kind: str, group: int, **values: Any) -> Entity:
    return Entity(
        **{
            'number': number,
            'kind': kind,
            'node': 0,
            'group': group,
            'period_s': 0.02,
            'work_s': 0.0,
            'spin_s': 0.0,
            'key': f'p{label(seed)}_k{number}',
            'effects': (),
            **values,
        }
    )


def _by_hand(
    seed: int,
    threads: int,
    groups: tuple[Group, ...],
    entities: tuple[Entity, ...],
    fed: tuple[int, ...],
) -> Program:
    return Program(
        seed=seed,
        executor=MULTI,
        threads=threads,
        nodes=1,
        groups=groups,
        entities=entities,
        feeds=tuple((0.003, number) for number in fed),
    )


WRITTEN_BY_HAND = (
    _busy_group_with_client_and_service,
    _rivals,
    _busy_pool,
    _two_tasks,
    _arrivals_while_busy,
)
