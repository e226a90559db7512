"""
From a closed specification to a complete UPPAAL model and its queries.

Owns the text of the models; the templates under ``profiles/`` are the only description of the
executor's semantics. Knows nothing of how a model is explored.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import MappingProxyType

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from ros2cc_extract.generator.queries import (
    Family,
    Query,
    paper_queries,
    rclpy_queries,
    write_query_file,
)
from ros2cc_extract.generator.sources import PUBLISHED, Profile, Text, choose_sources
from ros2cc_extract.generator.unit import Unit, number_unit
from ros2cc_extract.spec.close import ClosedSpec

__all__ = ['Family', 'Profile', 'Query', 'RenderedModel', 'Text', 'render']

#: What compact texts let move; docs/model.md shows that more would change no verdict.
CALLBACKS_IN_PLAY = 2
THREADS_IN_PLAY = 2
#: Unlimited arrivals: the member of a group served first starves by two others, not by one.
CALLBACKS_IN_PLAY_FOR_EVER = 3


@dataclass(frozen=True, kw_only=True)
class RenderedModel:
    """
    A model ready to be written.

    :param name: name of the unit.
    :param xml: the complete model, as UPPAAL opens it, queries included.
    :param queries: in the order of ``q`` and of the queries of ``xml``.
    :param published: the files of the published tool by file name, to be pasted into the
        published template, which has a bound on arrivals: none of them where there is no bound.
    """

    name: str
    xml: str
    queries: tuple[Query, ...]
    q: str
    published: Mapping[str, str]


def render(
    closed: ClosedSpec,
    *,
    profile: Profile = Profile.PAPER,
    text: Text = Text.PLAIN,
    max_cycle: int | None = 1,
) -> RenderedModel:
    """
    Write the model of ``closed``.

    :param max_cycle: how often each callback may become ready, at least 1; ``None`` for no bound.
    :raises ValueError: when ``max_cycle`` is below 1.
    """
    if max_cycle is not None and max_cycle < 1:
        raise ValueError(f'max_cycle must be at least 1, not {max_cycle}')
    unit = number_unit(closed, max_cycle)
    published = paper_queries(unit)
    queries = rclpy_queries(unit) if profile is Profile.RCLPY else published
    return RenderedModel(
        name=unit.name,
        xml=_write_xml(unit, queries, profile, text),
        queries=queries,
        q=write_query_file(queries),
        published=_write_published_files(unit, published),
    )


def _write_xml(unit: Unit, queries: tuple[Query, ...], profile: Profile, text: Text) -> str:
    sources = choose_sources(profile, text, unit)
    in_play = CALLBACKS_IN_PLAY if unit.max_cycle else CALLBACKS_IN_PLAY_FOR_EVER
    values = {
        'unit': unit,
        'callbacks_in_play': in_play if text is Text.COMPACT else None,
        'threads_in_play': THREADS_IN_PLAY,
    }
    return _fill(
        'shared/model.xml.j2',
        **values,
        queries=queries,
        automata=sources.automata,
        declarations=_fill(sources.declarations, **values),
        system=_fill(sources.system, **values),
    )


def _write_published_files(unit: Unit, queries: tuple[Query, ...]) -> Mapping[str, str]:
    if unit.max_cycle is None:
        return MappingProxyType({})
    return MappingProxyType(
        {
            f'{unit.name}_declarations.c': _fill(PUBLISHED.declarations, unit=unit),
            f'{unit.name}_system.c': _fill(PUBLISHED.system, unit=unit),
            f'{unit.name}_query.q': write_query_file(queries),
        }
    )


def _fill(template: str, **values: object) -> str:
    return _environment().get_template(template).render(values)


@cache
def _environment() -> Environment:
    return Environment(
        loader=FileSystemLoader(Path(__file__).parent / 'profiles'),
        autoescape=lambda name: name is not None and name.endswith('.xml.j2'),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
