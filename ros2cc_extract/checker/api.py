"""The public door of the checker: read a model, read queries, check."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property, partial
from pathlib import Path

from ros2cc_extract.checker import engines
from ros2cc_extract.checker.limits import Limits, Progress, peak_mb
from ros2cc_extract.checker.network import Network, Property
from ros2cc_extract.checker.replay import Replayer
from ros2cc_extract.checker.run import EdgeRef, Run, StateView, Step
from ros2cc_extract.checker.search import (
    INTERRUPTED,
    NO_REDUCTIONS,
    Fairness,
    Reductions,
    Verdict,
)
from ros2cc_extract.checker.uppaal.document import read_document
from ros2cc_extract.checker.uppaal.elaborate import Elaboration, elaborate
from ros2cc_extract.checker.uppaal.queryfile import Query, clean, first_line, read_query_file
from ros2cc_extract.errors import InputError, ModelFormatError
from ros2cc_extract.files import read_named
from ros2cc_extract.places import Place

__all__ = [
    'Answer',
    'CheckResult',
    'EdgeRef',
    'EngineKind',
    'Fairness',
    'Limits',
    'Model',
    'Progress',
    'Query',
    'Reductions',
    'Run',
    'StateView',
    'Step',
    'Verdict',
    'check',
    'load_model',
    'model_text',
    'read_model',
    'read_queries',
]

MOST_MODEL_BYTES = 64_000_000


_TOO_DEEP = 'functions and expressions nest too deep'
_MEND_DEEP = 'call fewer functions inside functions, or use variables for parts'


class EngineKind(Enum):
    """Who searches; AUTO is the native core where it is built."""

    AUTO = 'auto'
    REFERENCE = 'reference'
    NATIVE = 'native'


@dataclass(frozen=True, eq=False)
class Model:
    """
    An elaborated model.

    :param queries: those stored in the XML.
    """

    name: str
    elaboration: Elaboration
    queries: tuple[Query, ...]

    @property
    def network(self) -> Network:
        """The network that engines see."""
        return self.elaboration.network()

    @property
    def processes(self) -> tuple[str, ...]:
        """Names of the processes in system order."""
        return tuple(process.name for process in self.network.processes)

    def process_index(self, name: str) -> int:
        """
        Return the position of a process in the system line.

        :raises InputError: there is no process of that name.
        """
        if name not in self.processes:
            known = ', '.join(self.processes[:8])
            what = f'there is no process {name!r}'
            raise InputError(what, Place(self.name), f'known are {known}')
        return self.processes.index(name)

    def template_of(self, name: str) -> str:
        """Return the template of a process."""
        return self.network.processes[self.process_index(name)].template


@dataclass(frozen=True, kw_only=True)
class Answer:
    """
    The verdict of one query.

    :param reason: why the verdict is undecided.
    :param seconds: when it was known, from the start of the search.
    :param replay: gives the witness or counterexample; None where none exists or was found.
    """

    query: Query
    verdict: Verdict
    reason: str | None
    seconds: float
    replay: Callable[[], Run] | None = field(repr=False, compare=False)

    @property
    def is_interrupted(self) -> bool:
        """Whether a Ctrl-C left it undecided."""
        return self.reason == INTERRUPTED

    @cached_property
    def path(self) -> Run | None:
        """
        The witness or counterexample, replayed step by step when it is first asked for.

        :raises CoreMismatchError: when it could not be replayed (a defect).
        """
        return self.replay() if self.replay else None


@dataclass(frozen=True, kw_only=True)
class CheckResult:
    """
    Answers to all queries.

    :param engine: name of the engine that searched.
    :param note: what the user should know about the choice of the engine; often empty.
    :param complete: whether all reachable states were explored.
    """

    engine: str
    note: str = ''
    states: int
    transitions: int
    seconds: float
    peak_mb: float
    complete: bool
    answers: tuple[Answer, ...]


def load_model(path: Path) -> Model:
    """
    Read a model file.

    :raises InputError: the file cannot be read.
    :raises ModelFormatError: it is no model of the supported subset.
    """
    return _model(model_text(path), path.as_posix(), None)


def model_text(path: Path) -> bytes:
    """
    Read a model file as it is.

    :raises InputError: the file cannot be read.
    """
    return read_named(path, MOST_MODEL_BYTES, 'give a readable file')


def read_model(text: str, name: str) -> Model:
    """
    Read a model from text.

    :param name: file name for messages.
    :raises ModelFormatError: it is no model of the supported subset.
    """
    return _model(text.encode(), name, 'utf-8')


def _model(data: bytes, name: str, encoding: str | None) -> Model:
    document = read_document(data, name, encoding)
    try:
        elaboration = elaborate(document)
    except RecursionError:
        raise ModelFormatError(_TOO_DEEP, Place(name), _MEND_DEEP) from None
    queries = tuple(
        Query(
            clean(node.formula.value),
            node.comment,
            Place(name, first_line(node.formula.value, node.formula.line)),
        )
        for node in document.queries
    )
    return Model(name, elaboration, queries)


def read_queries(text: str, name: str) -> tuple[Query, ...]:
    """
    Read a query file.

    :raises ModelFormatError: a comment or query that is not complete, or no query.
    """
    return read_query_file(text, name)


def check(
    model: Model,
    queries: Sequence[Query],
    *,
    limits: Limits = Limits(),  # noqa: B008 - frozen value
    engine: EngineKind = EngineKind.AUTO,
    fairness: Fairness = Fairness.NONE,
    reduction: bool | Reductions = True,
    progress: Callable[[Progress], None] | None = None,
    jobs: int = 1,
) -> CheckResult:
    """
    Answer all queries by one exploration.

    :param reduction: explore fewer states where that keeps all verdicts.
    :param jobs: threads that explore together; the answer does not depend on them.
    :raises ModelFormatError: a query is wrong, or a reachable state breaks a range.
    :raises ToolNotFoundError: the native core was asked for and is not built.
    :raises CoreMismatchError: a path of a reduced search could not be replayed (a defect).
    """
    if isinstance(reduction, bool):
        reduction = Reductions() if reduction else NO_REDUCTIONS
    try:
        return _check(model, queries, limits, engine, fairness, reduction, progress, jobs)
    except RecursionError:
        raise ModelFormatError(_TOO_DEEP, Place(model.name), _MEND_DEEP) from None


def _properties(model: Model, queries: Sequence[Query], limits: Limits) -> list[Property] | None:
    """Read all queries, which a large unit has by the hundred thousand; None: the time is over."""
    unnamed = Place('query', 1)
    properties = []
    for query in queries:
        if limits.is_over:
            return None
        properties.append(model.elaboration.query(query.formula, query.place or unnamed))
    return properties


def _unsearched(queries: Sequence[Query], limits: Limits, engine: engines.Engine) -> CheckResult:
    reason = limits.deadline.reason if limits.deadline else None
    return CheckResult(
        engine=engine.name,
        states=0,
        transitions=0,
        seconds=0.0,
        peak_mb=peak_mb(),
        complete=False,
        answers=tuple(
            Answer(query=query, verdict=Verdict.UNDECIDED, reason=reason, seconds=0.0, replay=None)
            for query in queries
        ),
    )


def _check(
    model: Model,
    queries: Sequence[Query],
    limits: Limits,
    engine: EngineKind,
    fairness: Fairness,
    reductions: Reductions,
    progress: Callable[[Progress], None] | None,
    jobs: int,
) -> CheckResult:
    chosen = engines.choose(engine.value)
    properties = _properties(model, queries, limits)
    if properties is None:
        return _unsearched(queries, limits, chosen)
    network = model.network
    result = chosen.search(
        network,
        properties,
        limits=limits,
        fairness=fairness,
        reductions=reductions,
        progress=progress,
        jobs=jobs,
    )
    replayer = Replayer(model.elaboration, network, fairness)
    answers = tuple(
        Answer(
            query=query,
            verdict=outcome.verdict,
            reason=outcome.reason,
            seconds=outcome.seconds,
            replay=partial(replayer.run, prop, outcome.path, result.reduce)
            if outcome.path
            else None,
        )
        for query, prop, outcome in zip(queries, properties, result.outcomes, strict=True)
    )
    if result.reduce is not None:
        for answer in answers:
            _ = answer.path  # a reduction that goes wrong must fail before its verdict is seen
    return CheckResult(
        engine=chosen.name,
        states=result.states,
        transitions=result.transitions,
        seconds=result.seconds,
        peak_mb=peak_mb(),
        complete=result.complete,
        answers=answers,
    )
