"""Ask queries that a user has written: of a model file, or of the model of a unit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ros2cc_extract.checker.api import (
    Model,
    Query,
    load_model,
    model_text,
    read_model,
    read_queries,
)
from ros2cc_extract.checker.uppaal.model import MOST_MODEL_BYTES
from ros2cc_extract.errors import InputError, ModelFormatError
from ros2cc_extract.files import read_named
from ros2cc_extract.generator import build
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.results.results import QueryResult, Verification, verification_of
from ros2cc_extract.verify.results.run_evidence import Names
from ros2cc_extract.verify.search.model_search import (
    RunDescriber,
    also_begun,
    ask_verifyta,
    check_queries,
    result_of,
)
from ros2cc_extract.verify.search.options import DEFAULTS, Checker, OnProgress, Options
from ros2cc_extract.verify.search.reading_deadline import limited_reading


def ask_unit(
    closed: ClosedSpec,
    queries: Sequence[Query],
    options: Options = DEFAULTS,
    progress: OnProgress | None = None,
    watched: str | None = None,
) -> Verification:
    """
    Ask other queries than its own of a unit.

    They are always asked of the plain text: the compact text keeps only what
    its own queries can see.

    :param watched: what ``watcher.seen`` of the queries has seen, as of ``render_alone``.
    """
    options = replace(options, limits=options.limits.begun())
    with limited_reading(options.limits, Path(closed.spec.name)) as has_begun:
        rendered = build.render_alone(
            closed,
            profile=options.profile,
            text=build.Text.PLAIN,
            max_cycle=options.max_cycle,
            watched=watched,
        )
        model = read_model(rendered.xml, f'{rendered.name}.xml')
        names, watch = Names.of(closed.spec), also_begun(has_begun, progress)
        found = _asked(model, rendered.xml.encode(), queries, options, watch, names)
    return replace(
        found,
        model=rendered.name,
        profile=options.profile.value,
        text=build.Text.PLAIN.value,
        assumptions=closed.assumptions,
    )


def verify_model(
    path: Path,
    queries: Sequence[Query] = (),
    options: Options = DEFAULTS,
    progress: OnProgress | None = None,
) -> Verification:
    """
    Check a model file, by the queries given or by those in the model.

    :raises InputError: when there is no query, or the file cannot be read, also not in time.
    :raises ModelFormatError: when it is outside our subset; verifyta takes it all the same.
    """
    options = replace(options, limits=options.limits.begun())
    with limited_reading(options.limits, path) as has_begun:
        return _verify_model(path, queries, options, also_begun(has_begun, progress))


def _verify_model(
    path: Path, queries: Sequence[Query], options: Options, progress: OnProgress
) -> Verification:
    try:
        model = load_model(path)
    except ModelFormatError as error:
        if options.checker is not Checker.VERIFYTA or not queries:
            raise
        return _verify_unread(path, queries, options, error)
    queries = queries or model.queries
    if not queries:
        place = Place(str(path))
        raise InputError('no query found', place, 'name a .q file after the model, or use --query')
    return replace(
        _asked(model, model_text(path), queries, options, progress, Names()), model=path.name
    )


def _verify_unread(
    path: Path, queries: Sequence[Query], options: Options, error: ModelFormatError
) -> Verification:
    """Have verifyta check what only it can read; no run is shown, as none can be replayed."""
    result = ask_verifyta(None, model_text(path), queries, options)
    results = tuple(
        QueryResult(
            family=None,
            formula=answer.query.formula,
            words=answer.query.comment or answer.query.formula,
            callbacks=(),
            verdict=answer.verdict,
            reason=answer.reason,
            seconds=answer.seconds,
            run=None,
        )
        for answer in result.answers
    )
    note = f'{error}; so no run could be replayed'
    return verification_of(path.name, result, results, notes=(note,))


def _asked(
    model: Model,
    xml: bytes,
    queries: Sequence[Query],
    options: Options,
    progress: OnProgress | None,
    names: Names,
) -> Verification:
    result = check_queries(model, xml, queries, options, progress)
    describer = RunDescriber(model, xml, names)
    results = tuple(
        result_of(answer, describer, None, answer.query.comment or answer.query.formula, ())
        for answer in result.answers
    )
    return verification_of(model.name, result, results)


def load_queries(path: Path) -> tuple[Query, ...]:
    """
    Read a query file.

    :raises InputError: when it cannot be read or holds no query.
    """
    try:
        text = read_named(path, MOST_MODEL_BYTES).decode('utf-8')
    except UnicodeDecodeError:
        raise InputError('no UTF-8 text', Place(str(path)), 'is this a .q file?') from None
    return read_queries(text, str(path))
