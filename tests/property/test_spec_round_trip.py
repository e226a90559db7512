"""Writing and reading is the identity on any specification, and its schema allows it."""

from __future__ import annotations

import jsonschema
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import Access, Act, Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Origin,
    Spec,
    When,
    collect_unresolved,
)
from ros2cc_extract.spec.yaml.yaml_io import SPEC, read_specs, write_specs

texts = st.text(st.characters(codec='utf-8', exclude_categories=['Cc', 'Cs']), min_size=1)
files = st.from_regex(r'[a-z]{1,8}(/[a-z]{1,8})?\.py', fullmatch=True)
places = st.builds(Place, files, st.integers(1, 9999), st.integers(1, 200)) | st.builds(
    Place, files, st.integers(1, 9999)
)
maybe_places = st.none() | places
unknowns = st.builds(Unknown, texts, maybe_places)
seconds = st.floats(0, 1e6, allow_nan=False)
chains = st.lists(places, max_size=2).map(tuple)
blockings = st.builds(
    Blocking,
    call=texts,
    source=maybe_places,
    on=st.none() | texts | unknowns,
    seconds=st.none() | seconds | unknowns,
    chain=chains,
)
accesses = st.builds(
    Access,
    name=texts,
    source=maybe_places,
    locks=st.lists(texts, max_size=2).map(tuple),
    update=st.booleans(),
    chain=chains,
)
acts = st.builds(Act, name=texts | unknowns, source=maybe_places, chain=chains)
names = st.from_regex(r'[a-z]{3,6}_[a-z]{2,6}', fullmatch=True)


@st.composite
def callbacks(draw: st.DrawFn, name: str, group: str) -> Callback:
    entity = draw(st.sampled_from(EntityKind))
    is_timer = entity is EntityKind.TIMER
    return Callback(
        name=name,
        type=entity.published_type,
        group=group,
        entity=entity,
        node=draw(st.none() | texts | unknowns),
        function=draw(st.none() | texts),
        cls=draw(st.none() | texts),
        key=draw(st.none() | texts | unknowns) if entity.key_name else None,
        period_s=draw(st.none() | seconds | unknowns) if is_timer else None,
        count=draw(st.integers(1, 9) | unknowns),
        when=draw(st.sampled_from(When)),
        conditional=draw(st.booleans()),
        alternative=draw(st.none() | texts),
        coroutine=draw(st.booleans()),
        groupless=draw(st.booleans()),
        unresolved=draw(st.none() | unknowns),
        source=draw(maybe_places),
        defined=draw(maybe_places),
        blocking=draw(st.lists(blockings, max_size=2).map(tuple)),
        writes=draw(st.lists(accesses, max_size=2).map(tuple)),
        publishes=draw(st.lists(acts, max_size=2).map(tuple)),
    )


@st.composite
def specs(draw: st.DrawFn) -> Spec:
    taken = draw(st.lists(names, min_size=5, max_size=8, unique=True))
    unit, executor, group, thread, *rest = taken
    return Spec(
        name=unit,
        callbacks=tuple(draw(callbacks(name, group)) for name in rest),
        groups=(
            CallbackGroup(
                name=group,
                type=draw(st.sampled_from(GroupType)),
                default=draw(st.booleans()),
                node=draw(st.none() | texts),
                count=draw(st.integers(1, 3) | unknowns),
                unresolved=draw(st.none() | unknowns),
                source=draw(maybe_places),
            ),
        ),
        executor=Executor(
            name=executor,
            threads=(thread,),
            kind=draw(st.none() | names | unknowns),
            threads_source=draw(st.none() | texts),
            in_thread=draw(st.booleans()),
            source=draw(maybe_places),
        ),
        origin=draw(st.sampled_from(Origin)),
        nodes=tuple(draw(st.lists(texts, max_size=2))),
        entry=draw(st.none() | texts),
        rclpy=draw(st.none() | texts),
    )


@given(specs())
@settings(max_examples=30, deadline=None)
def test_any_specification_survives_its_file(spec: Spec) -> None:
    text = write_specs([spec])
    assert read_specs(text, 'unit.yaml') == (spec,)
    assert write_specs(read_specs(text, 'unit.yaml')) == text


@given(specs())
@settings(max_examples=12, deadline=None)
def test_any_file_written_fits_the_schema(spec: Spec) -> None:
    jsonschema.validate(yaml.safe_load(write_specs([spec])), SPEC.schema)


@given(specs())
@settings(max_examples=12, deadline=None)
def test_every_unknown_has_a_reason_in_the_list(spec: Spec) -> None:
    assert all(fact.reason for fact in collect_unresolved(spec))
