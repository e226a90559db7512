"""
Maximal paths that stay inside a predicate: lassos, dead ends, and states where time diverges.

Works on state numbers alone. A path counts when it runs round a cycle, ends in a deadlock, or
stays forever where time may diverge (UPPAAL documentation, page "Semantics of the requirement
specification language"). Under weak fairness a cycle counts only if every process is disabled
or moves somewhere on it, and idling never counts while a move is enabled.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Sequence

from ros2cc_extract.checker.engines.search import End
from ros2cc_extract.checker.engines.state_graph import DEADLOCK, Graph
from ros2cc_extract.light_dataclasses import dataclass

Inside = Callable[[int], int]


@dataclass(frozen=True)
class Lasso:
    """State numbers from the start; ``cycle_start`` indexes the state that follows the last."""

    states: tuple[int, ...]
    cycle_start: int | None
    end: End | None


def find_lasso(graph: Graph, starts: Iterable[int], inside: Inside) -> Lasso | None:
    """
    Find a maximal path inside from the first start that has one.

    Shortest to its turning point, then the shortest way round from there.
    """
    finished = bytearray(len(graph.parents))
    for start in starts:
        if not finished[start]:
            turn = _turning_point(graph, start, inside, finished)
            if turn is not None:
                return _nearest_lasso(graph, start, turn, inside)
    return None


_OPEN, _DONE = 1, 2


def _turning_point(graph: Graph, start: int, inside: Inside, colours: bytearray) -> int | None:
    """Depth-first search for an end or for a state on a cycle; colours what cannot reach one."""
    if graph.ends[start : start + 1] > b'\0':
        return start
    colours[start] = _OPEN
    stack = [(start, iter(graph.successors(start)))]
    while stack:
        state, following = stack[-1]
        for target in following:
            if colours[target] == _OPEN:
                return target
            if colours[target] == _DONE or not inside(target):
                continue
            if graph.ends[target]:
                return target
            colours[target] = _OPEN
            stack.append((target, iter(graph.successors(target))))
            break
        else:
            colours[state] = _DONE
            stack.pop()
    return None


def _nearest_lasso(graph: Graph, start: int, known: int, inside: Inside) -> Lasso:
    """Turn at the first state in breadth-first order that is cheap, else at the known one."""
    for candidate in _breadth_first(graph, start, inside, limit=_CANDIDATES):
        if graph.ends[candidate]:
            return _lasso_through(graph, start, candidate, inside)
        cycle = shortest_path(graph, candidate, {candidate}, inside, limit=_CYCLE_EFFORT)
        if cycle is not None:
            return _lasso_through(graph, start, candidate, inside)
    return _lasso_through(graph, start, known, inside)


#: How many states near the start are tried as turning points, and how far round each.
_CANDIDATES, _CYCLE_EFFORT = 64, 4096


def _breadth_first(graph: Graph, start: int, inside: Inside, limit: int) -> list[int]:
    seen, order = {start}, [start]
    for state in order:
        for target in graph.successors(state):
            if target not in seen and target < graph.expanded and inside(target):
                seen.add(target)
                order.append(target)
        if len(order) > limit:
            break
    return order[:limit]


def _lasso_through(graph: Graph, start: int, turn: int, inside: Inside) -> Lasso:
    stem = [start] if turn == start else _path(graph, start, turn, inside)
    if graph.ends[turn]:
        return Lasso(tuple(stem), None, end_of(graph, turn))
    cycle = _path(graph, turn, turn, inside)
    return Lasso((*stem, *cycle[1:-1]), len(stem) - 1, None)


def end_of(graph: Graph, state: int) -> End:
    """Return how a path ends in a state that is an end."""
    return End.DEADLOCK if graph.ends[state] == DEADLOCK else End.IDLE


def _path(graph: Graph, start: int, goal: int, inside: Inside) -> list[int]:
    found = shortest_path(graph, start, {goal}, inside)
    assert found is not None
    return found


def shortest_path(
    graph: Graph,
    start: int,
    goals: set[int],
    inside: Inside,
    limit: int | None = None,
) -> list[int] | None:
    """
    Return the shortest path of at least one step from ``start`` to a goal, staying inside.

    :param limit: give up after so many states.
    """
    before: dict[int, int] = {}
    waiting = deque([start])
    while waiting:
        state = waiting.popleft()
        for target in graph.successors(state):
            if target in goals and inside(target):
                path = [target, state]
                while path[-1] != start:
                    path.append(before[path[-1]])
                return path[::-1]
            if target not in before and target != start and inside(target):
                before[target] = state
                waiting.append(target)
        if limit is not None and len(before) > limit:
            return None
    return None


# -- weak fairness -----------------------------------------------------------------------


@dataclass(frozen=True)
class Movers:
    """
    What moves: for each label the bits of the processes that take part.

    :param all: bits of all processes.
    """

    of_label: Sequence[int]
    all: int


def find_fair_lasso(
    graph: Graph, starts: Iterable[int], inside: Inside, movers: Movers
) -> Lasso | None:
    """Find a deadlock or a fair cycle inside, from the first start that reaches one."""
    finished: set[int] = set()
    for start in starts:
        if start in finished:
            continue
        for component in components(graph, start, inside, finished):
            lasso = _fair_lasso(graph, start, component, inside, movers)
            if lasso is not None:
                return lasso
    return None


def _fair_lasso(
    graph: Graph, start: int, component: list[int], inside: Inside, movers: Movers
) -> Lasso | None:
    if len(component) == 1 and graph.ends[component[0]] == DEADLOCK:
        return _lasso_through(graph, start, component[0], inside)
    members = set(component)
    if len(component) == 1 and component[0] not in graph.successors(component[0]):
        return None
    goals = _fair_goals(graph, members, movers)
    if goals is None:
        return None
    turn = component[0]
    stem = [start] if turn == start else _path(graph, start, turn, inside)
    cycle = _tour(graph, turn, goals, members)
    return Lasso((*stem, *cycle[1:-1]), len(stem) - 1, None)


#: State, successor and label of a step; a successor of -1 stands for the state alone.
Goal = tuple[int, int, int]


def _fair_goals(graph: Graph, members: set[int], movers: Movers) -> list[Goal] | None:
    """Return for each process a state or step that makes the cycle fair to it, if all have one."""
    goals: dict[int, Goal] = {}
    for state in sorted(members):
        enabled = 0
        for k in range(graph.offsets[state], graph.offsets[state + 1]):
            moving = movers.of_label[graph.labels[k]]
            enabled |= moving
            if graph.targets[k] in members:
                _note(goals, moving, (state, graph.targets[k], graph.labels[k]))
        _note(goals, movers.all & ~enabled, (state, -1, -1))
    if len(goals) < movers.all.bit_count():
        return None
    return list(dict.fromkeys(goals.values()))


def _note(goals: dict[int, Goal], bits: int, goal: Goal) -> None:
    while bits:
        lowest = bits & -bits
        goals.setdefault(lowest, goal)
        bits ^= lowest


def _tour(graph: Graph, turn: int, goals: list[Goal], members: set[int]) -> list[int]:
    """Return a closed walk from ``turn`` through all goals, inside one component."""
    walk = [turn]
    for state, successor, _ in goals:
        if walk[-1] != state:
            walk += _path(graph, walk[-1], state, members.__contains__)[1:]
        if successor >= 0:
            walk.append(successor)
    if walk[-1] != turn or len(walk) == 1:
        walk += _path(graph, walk[-1], turn, members.__contains__)[1:]
    return walk


def components(
    graph: Graph, start: int, inside: Inside, finished: set[int]
) -> Iterable[list[int]]:
    """
    Yield the strongly connected components reachable inside (Tarjan, without recursion).

    :param finished: states of earlier calls, to be skipped; grows.
    """
    numbers: dict[int, int] = {start: 0}
    low: dict[int, int] = {start: 0}
    trail = [start]
    stack = [(start, iter(graph.successors(start)))]
    while stack:
        state, following = stack[-1]
        for target in following:
            if target in numbers:
                if target not in finished:
                    low[state] = min(low[state], numbers[target])
            elif target not in finished and target < graph.expanded and inside(target):
                numbers[target] = low[target] = len(numbers)
                trail.append(target)
                stack.append((target, iter(graph.successors(target))))
                break
        else:
            stack.pop()
            if stack:
                low[stack[-1][0]] = min(low[stack[-1][0]], low[state])
            if low[state] == numbers[state]:
                at = _rindex(trail, state)
                component, trail[at:] = trail[at:], []
                finished.update(component)
                yield sorted(component)


def _rindex(trail: list[int], state: int) -> int:
    at = len(trail) - 1
    while trail[at] != state:
        at -= 1
    return at
