"""
The reference engine: exact exploration in plain Python, all queries at once.

Breadth-first, so that the first state that decides a query is as near as any. The native core
must agree with this engine.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import field

from ros2cc_extract.checker.analyses.canonical_states import Reducer
from ros2cc_extract.checker.analyses.dead_variables import Forgetting, forgettings
from ros2cc_extract.checker.engines.generated_successors import Moving, Plan
from ros2cc_extract.checker.engines.limits import Limits, Progress, Watch, states_reason
from ros2cc_extract.checker.engines.liveness import Lasso, Movers, find_fair_lasso, find_lasso
from ros2cc_extract.checker.engines.search import (
    INTERRUPTED,
    Outcome,
    Reductions,
    SearchResult,
    StatePath,
    formulas_of,
    found,
    goal_of,
    inside_of,
    not_found,
    positions,
)
from ros2cc_extract.checker.engines.state_graph import DEADLOCK, IDLE, Graph
from ros2cc_extract.checker.engines.state_layout import Layout
from ros2cc_extract.checker.engines.terms import Fairness
from ros2cc_extract.checker.network.network import Expr, Network, Property, QueryKind
from ros2cc_extract.checker.network.semantics import Semantics
from ros2cc_extract.checker.network.traversal import mentions_deadlock
from ros2cc_extract.light_dataclasses import dataclass

_LOOK_EVERY = 256
_MAX_CACHED_PREDICATES = 200_000
_MAX_CACHED_STATES = 200_000


def search(
    network: Network,
    properties: Sequence[Property],
    *,
    limits: Limits,
    fairness: Fairness,
    reductions: Reductions,
    progress: Callable[[Progress], None] | None,
    jobs: int,
) -> SearchResult:
    """
    Answer all properties by one exploration.

    :param reductions: dead variables only; the others are the core's.
    :param jobs: of no use here.
    :raises ModelFormatError: a reachable state breaks a range, an index or a loop bound.
    """
    forgotten = forgettings(network, formulas_of(properties)) if reductions.dead else ()
    exploration = _Exploration(network, properties, limits, fairness, forgotten, progress)
    exploration.run()
    return exploration.result()


@dataclass(eq=False)
class _Predicates:
    """
    Bits of the properties' formulae, remembered by the part of the state they depend on.

    Bit i of a reachability property is set where the search for it ends; the further bits are
    of ``inside`` and ``start`` of the liveness properties.
    """

    exprs: list[Expr]
    moving: Moving
    layout: Layout
    _cache: dict[int, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._function = self.moving.predicate(self.exprs)
        self._support = 0
        for expr in self.exprs:
            self._support |= self.layout.support(expr)
        # One bit above the state marks deadlocks, where that matters.
        reads_deadlock = any(mentions_deadlock(expr) for expr in self.exprs)
        self._dead_bit = 1 << self.layout.bits if reads_deadlock else 0

    def bits(self, packed: int, is_deadlock: bool) -> int:
        key = packed & self._support
        if is_deadlock:
            key |= self._dead_bit
        known = self._cache.get(key)
        if known is None:
            if len(self._cache) >= _MAX_CACHED_PREDICATES:
                self._cache.clear()
            known = self._cache[key] = self._function(packed, is_deadlock)
        return known


class _Exploration:
    def __init__(
        self,
        network: Network,
        properties: Sequence[Property],
        limits: Limits,
        fairness: Fairness,
        forgotten: tuple[Forgetting, ...],
        progress: Callable[[Progress], None] | None,
    ) -> None:
        self._network, self._properties = network, properties
        self._watch = Watch(limits, progress)
        self._max_states = limits.states
        self._reducer = Reducer(network, forgotten, ()) if forgotten else None
        self._reduced: dict[tuple[int, int], int] = {}
        self._layout = Layout(network)
        self._moving = Moving(network, self._layout)
        self._fairness = fairness
        self._reachability = positions(properties, reachability=True)
        self._liveness = positions(properties, reachability=False)
        self._predicates = _Predicates(self._formulas(), self._moving, self._layout)
        self._graph = Graph()
        self._order = [self._layout.pack(Semantics(network).initial())]
        self._transitions = 0
        self._hits: dict[int, tuple[int, float]] = {}
        self._reason: str | None = None
        self._outcomes: dict[int, Outcome] = {}

    def _formulas(self) -> list[Expr]:
        exprs = [goal_of(self._properties[i]) for i in self._reachability]
        for i in self._liveness:
            prop = self._properties[i]
            exprs += [inside_of(prop), prop.premise or inside_of(prop)]
        return exprs

    # -- exploration ---------------------------------------------------------------------
    def run(self) -> None:
        """Explore until all is known or a limit is hit."""
        try:
            self._explore()
        except KeyboardInterrupt:
            self._reason = INTERRUPTED

    def _explore(self) -> None:
        plans: dict[int, Plan] = {}
        known = {self._order[0]: 0}
        order, graph = self._order, self._graph
        location_mask = self._layout.location_mask
        keeps_edges = bool(self._liveness)
        keeps_labels = keeps_edges and self._fairness is Fairness.WEAK
        pending = (1 << len(self._reachability)) - 1
        all_reached = not keeps_edges and bool(self._reachability)
        transitions = 0
        for number, packed in enumerate(order):
            if not number % _LOOK_EVERY:
                self._transitions = transitions
                self._reason = self._watch.broken(len(order), transitions)
                if self._reason:
                    return
            vector = packed & location_mask
            plan = plans.get(vector)
            if plan is None:
                plan = plans[vector] = self._moving.plan(packed)
            before = transitions
            for move, label in plan.steps:
                if label >= 0:
                    target = move(packed)
                    if target < 0:
                        continue
                    moves = ((target, label),)
                else:
                    moves = move(packed)
                for target, label in moves:
                    if self._reducer is not None:
                        target = self._forget(target, label)
                    if len(order) == self._max_states and target not in known:
                        self._transitions = before
                        self._reason = states_reason(self._max_states)
                        return
                    transitions += 1
                    index = known.setdefault(target, len(order))
                    if index == len(order):
                        order.append(target)
                        graph.parents.append(number)
                    if keeps_edges:
                        graph.targets.append(index)
                        if keeps_labels:
                            graph.labels.append(label)
            is_deadlock = transitions == before
            bits = self._predicates.bits(packed, is_deadlock)
            hit = bits & pending
            if hit:
                pending &= ~hit
                self._note_hits(hit, number)
                if not pending and all_reached:
                    self._transitions = transitions
                    return
            if keeps_edges:
                graph.masks.append(bits)
                graph.offsets.append(len(graph.targets))
                graph.ends.append(DEADLOCK if is_deadlock else IDLE if plan.is_idle(packed) else 0)
        self._transitions = transitions

    def _forget(self, packed: int, label: int) -> int:
        key = packed, label
        if key not in self._reduced:
            assert self._reducer is not None
            state = self._reducer.forget(self._layout.unpack(packed), self._moving.labels[label])
            if len(self._reduced) >= _MAX_CACHED_STATES:
                self._reduced.clear()
            self._reduced[key] = self._layout.pack(state)
        return self._reduced[key]

    def _note_hits(self, hit: int, number: int) -> None:
        seconds = self._watch.seconds()
        for i, prop in enumerate(self._reachability):
            if hit >> i & 1:
                self._hits[prop] = number, seconds

    # -- answers -------------------------------------------------------------------------
    def result(self) -> SearchResult:
        """Return the answers; looks for lassos in what was explored."""
        explored = self._watch.seconds()
        for i in self._reachability:
            prop = self._properties[i]
            if i in self._hits:
                number, seconds = self._hits[i]
                path = self._state_path(self._graph.path_to(number))
                self._outcomes[i] = found(prop, seconds, path)
            else:
                self._outcomes[i] = not_found(prop, explored, self._reason)
        for k, i in enumerate(self._liveness):
            self._outcomes[i] = self._liveness_outcome(k, self._properties[i])
        return SearchResult(
            len(self._order),
            self._transitions,
            self._watch.seconds(),
            self._is_complete(),
            tuple(self._outcomes[i] for i in range(len(self._properties))),
            self._reducer,
        )

    def _is_complete(self) -> bool:
        if self._reason:
            return False
        stopped_early = not self._liveness and len(self._hits) == len(self._properties)
        return not (stopped_early and self._properties)

    def _liveness_outcome(self, k: int, prop: Property) -> Outcome:
        late = INTERRUPTED if self._reason == INTERRUPTED else self._watch.exhausted()
        if late:
            self._reason = self._reason or late
            return not_found(prop, self._watch.seconds(), self._reason)
        try:
            lasso = self._lasso(k, prop)
        except KeyboardInterrupt:
            self._reason = INTERRUPTED
            return not_found(prop, self._watch.seconds(), self._reason)
        seconds = self._watch.seconds()
        if lasso is None:
            return not_found(prop, seconds, self._reason)
        prefix = self._graph.path_to(lasso.states[0])[:-1]
        start = None if lasso.cycle_start is None else len(prefix) + lasso.cycle_start
        path = self._state_path([*prefix, *lasso.states], start, lasso)
        return found(prop, seconds, path)

    def _lasso(self, k: int, prop: Property) -> Lasso | None:
        masks, graph = self._graph.masks, self._graph
        inside_bit = 1 << len(self._reachability) + 2 * k
        wanted = inside_bit | inside_bit << 1

        def inside(state: int) -> int:
            return state < graph.expanded and masks[state] & inside_bit

        starts = self._starts(prop, wanted)
        if self._fairness is Fairness.NONE:
            return find_lasso(graph, starts, inside)
        return find_fair_lasso(graph, starts, inside, self._movers())

    def _starts(self, prop: Property, wanted: int) -> Iterator[int]:
        masks = self._graph.masks
        if prop.kind is QueryKind.LEADS_TO:
            return (i for i, bits in enumerate(masks) if bits & wanted == wanted)
        return (i for i in range(min(1, len(masks))) if masks[i] & wanted == wanted)

    def _movers(self) -> Movers:
        of_label = [sum(1 << process for process, _ in edges) for edges in self._moving.labels]
        return Movers(of_label, (1 << len(self._network.processes)) - 1)

    def _state_path(
        self, numbers: Sequence[int], cycle_start: int | None = None, lasso: Lasso | None = None
    ) -> StatePath:
        states = tuple(self._layout.unpack(self._order[number]) for number in numbers)
        return StatePath(states, cycle_start, lasso.end if lasso else None)
