"""Small hand-drawn models for the checker's tests."""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.checker.api import (
    CheckResult,
    EngineKind,
    Fairness,
    Limits,
    Model,
    Query,
    check,
    read_model,
)
from tests.support.published import document, edge, location, template

_LABEL = {
    'select': 'select',
    'guard': 'guard',
    'sync': 'synchronisation',
    'do': 'assignment',
    'say': 'comments',
}


def automaton(name: str, drawing: str, parameters: str = '', local: str = '') -> str:
    """
    Return a template drawn in text.

    First line: locations, ``U:`` or ``C:`` before urgent and committed ones, the first initial.
    Further lines: ``source -> target; guard: …; sync: …; do: …; select: …; say: …``.
    """
    head, *lines = [line.strip() for line in drawing.strip().splitlines()]
    locations = ''
    names = []
    for word in head.split():
        kind, _, bare = word.rpartition(':')
        locations += location(bare, {'U': 'urgent', 'C': 'committed', '': ''}[kind])
        names.append(bare)
    return template(name, parameters, local, locations, names[0], ''.join(map(_edge, lines)))


def _edge(line: str) -> str:
    ends, *labels = [part.strip() for part in line.split(';')]
    source, target = ends.split(' -> ')
    pairs = [label.split(':', 1) for label in labels if label]
    return edge(source, target, **{_LABEL[key.strip()]: text.strip() for key, text in pairs})


def network(*templates: str, declaration: str = '', system: str = '') -> Model:
    """Return a model; without ``system`` one process ``P`` of the template ``P``."""
    return read_model(document(declaration, ''.join(templates), system or 'system P;'), 'm.xml')


def single(drawing: str, declaration: str = '', local: str = '') -> Model:
    """Return the model of one process ``P``."""
    return network(automaton('P', drawing, local=local), declaration=declaration)


def ask(
    model: Model,
    *formulas: str,
    engine: EngineKind = EngineKind.AUTO,
    fairness: Fairness = Fairness.NONE,
    limits: Limits | None = None,
    reduction: bool = True,
) -> CheckResult:
    """Check formulas."""
    queries = [Query(formula, '', None) for formula in formulas]
    return check(
        model,
        queries,
        engine=engine,
        fairness=fairness,
        limits=limits or Limits(),
        reduction=reduction,
    )


def verdicts(model: Model, *formulas: str, **options: object) -> list[str]:
    """Return the verdicts as words."""
    return [a.verdict.value for a in ask(model, *formulas, **options).answers]  # type: ignore[arg-type]


def holds(model: Model, *formulas: str, **options: object) -> list[bool]:
    """Return whether each formula is satisfied; none may be undecided."""
    words = verdicts(model, *formulas, **options)
    assert 'undecided' not in words
    return [word == 'satisfied' for word in words]


def labels_of(steps: Sequence[object]) -> list[str]:
    """Return the steps of a run as ``process:source->target`` joined by ``+``."""
    return [
        '+'.join(f'{e.process}:{e.source}->{e.target}' for e in step.edges)  # type: ignore[attr-defined]
        for step in steps
    ]
