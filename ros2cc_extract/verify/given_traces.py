"""Put a run that UPPAAL saved or printed into words: find it in the model and replay it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ros2cc_extract.checker.api import Model, Query, load_model, model_text, read_model
from ros2cc_extract.checker.runs.printed_runs import NamedState, replay_named
from ros2cc_extract.errors import InputError
from ros2cc_extract.files import read_named
from ros2cc_extract.generator import build
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.results.evidence import Evidence
from ros2cc_extract.verify.results.run_evidence import Names, describe
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.uppaal.run import UppaalRun
from ros2cc_extract.verify.uppaal.trace_xml import read_xml
from ros2cc_extract.verify.uppaal.trace_xtr import read_xtr
from ros2cc_extract.verify.uppaal.verifyta_trace import read_runs

MOST_RUN_BYTES = 256_000_000
_SOME = Query('E<> true', '', None)
_ENDLESS = Query('E[] true', '', None)


def describe_unit_run(closed: ClosedSpec, run: Path, options: Options) -> Evidence:
    """
    Put into words a run of a unit's model, of the profile and text that the options name.

    :raises InputError: when it cannot be read or is no run of that model.
    """
    rendered = build.render_alone(
        closed, profile=options.profile, text=options.text, max_cycle=options.max_cycle
    )
    model = read_model(rendered.xml, f'{rendered.name}.xml')
    return _retold(model, rendered.xml.encode(), run, Names.of(closed.spec))


def describe_model_run(path: Path, run: Path) -> Evidence:
    """
    Put into words a run of a model file.

    :raises InputError: when one cannot be read, or the run is not of the model.
    """
    return _retold(load_model(path), model_text(path), run, Names())


def _retold(model: Model, xml: bytes, path: Path, names: Names) -> Evidence:
    source = Place(path.as_posix())
    states = _read(path, model, source)
    query = _ENDLESS if states[-1:] and states[-1] in states[:-1] else _SOME
    found = replay_named(model, query, states, source)
    return replace(describe(found, names), origin=UppaalRun(model, xml, found))


def _read(path: Path, model: Model, source: Place) -> tuple[NamedState, ...]:
    """Read any of the three layouts; of several printed runs the first."""
    try:
        text = read_named(path, MOST_RUN_BYTES).decode('utf-8')
    except UnicodeDecodeError:
        raise InputError('no UTF-8 text', source, 'give a run that UPPAAL saved') from None
    if text.lstrip().startswith('<'):
        return read_xml(text, source)
    printed = read_runs(text)
    return printed[0] if printed else read_xtr(text, model, source)
