from collections.abc import Callable, Sequence

from ros2cc_extract.checker.engines.native_tables import Family, Predicate

OPERATIONS: list[str]

class CheckError(Exception): ...
class EndlessError(Exception): ...
class UnevenError(Exception): ...

class Answer:
    path: list[list[int]]
    cycle_start: int
    end: int
    seconds: float

class Result:
    states: int
    transitions: int
    is_complete: bool
    is_full: bool
    goals: list[Answer]
    lassos: list[Answer]

def search(
    *,
    nodes: list[int],
    lists: list[int],
    ranges: list[int],
    functions: list[int],
    edges: list[int],
    channels: list[int],
    variables: list[int],
    initial: list[int],
    locations: list[list[int]],
    forgettings: list[tuple[list[int], int, list[int]]],
    families: list[Family],
    picks: list[int],
    goals: Sequence[Predicate],
    lassos: Sequence[tuple[Predicate, Predicate | None]],
    is_fair: bool,
    runs_chains: bool,
    max_states: int,
    jobs: tuple[int, int],
    watch: Callable[[int, int, int, bool], bool],
) -> Result: ...
