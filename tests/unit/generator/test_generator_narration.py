import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from generator_units import closed_unit, every_text

from ros2cc_extract.checker.api import read_model
from ros2cc_extract.generator import build
from ros2cc_extract.generator.build import Text, render
from ros2cc_extract.generator.events import FieldText, read_annotation
from ros2cc_extract.verify.results.events import WORDS, Event

# Of what is installed: the sources may not be here.
PROFILES = Path(build.__file__).parent / 'profiles'
ARM = closed_unit('tick:TMR:a scan:SUB:b', 'a:EXCLUSIVE b:REENTRANT', 2)
#: What a template writes in one case, and else.
CHOICE = re.compile(r"\{\{ '([^']*)' if [^}]*?(?: else '([^']*)')? \}\}")
TEXTS = every_text('tick:TMR:a scan:SUB:b', 'a:EXCLUSIVE b:REENTRANT')


def narration(xml: str, template: str) -> list[str]:
    """The sentences of one template, in the order of its edges."""
    root = ElementTree.fromstring(xml.encode())
    return [
        label.text or ''
        for item in root.iter('template')
        if item.findtext('name') == template
        for label in item.iter('label')
        if label.get('kind') == 'comments'
    ]


def test_threads_tell_what_starts_and_ends():
    assert narration(render(ARM).xml, 'Thread') == [
        'event start; who: callback my_cb_id; thread: thread id',
        'event end; who: callback my_cb_id; thread: thread id',
    ]


def test_groups_and_callbacks_tell_their_changes():
    xml = render(ARM).xml
    assert narration(xml, 'CallbackGroup') == [
        'event close; group: group id',
        'event open; group: group id',
    ]
    assert narration(xml, 'Callback') == [
        'event ready; who: callback id',
        'event unready; who: callback id',
    ]


def test_executor_tells_its_decisions():
    assert narration(render(ARM).xml, 'Executor') == [
        'event poll; executor: executor',
        'event full; executor: executor',
        'event free; executor: executor; thread: thread cur_thread_id',
        'event assign; executor: executor; who: callback cur_cb_id; thread: thread cur_thread_id',
        'event pass; executor: executor; who: callback cur_cb_id',
    ]


def test_the_compact_executor_says_why_it_passes_over_a_callback():
    assert narration(render(ARM, text=Text.COMPACT).xml, 'Executor') == [
        'event assign; executor: executor; who: callback cur_cb_id - 1; '
        'thread: thread lowest_idle_thread()',
        'event pass unready; executor: executor; who: callback cur_cb_id - 1',
        'event pass closed; executor: executor; who: callback cur_cb_id - 1',
        'event poll; executor: executor',
        'event poll seen; executor: executor; who: callback watched_cb_id',
    ]


@pytest.mark.parametrize('text', TEXTS)
def test_every_event_can_be_told(text: str):
    """Each comment is an event with words, whose expressions the checker evaluates."""
    model = read_model(TEXTS[text], 'arm.xml')
    for process in model.network.processes:
        for edge in filter(lambda edge: edge.comment, process.edges):
            annotation = read_annotation(edge.comment)
            assert annotation is not None, edge.comment
            fields = dict.fromkeys((field.name for field in annotation.fields), '…')
            said = Event(kind=annotation.kind, form=annotation.form, **fields)  # type: ignore[arg-type]
            assert 'None' not in said.words
            for field in annotation.fields:
                if field.expression:
                    model.elaboration.expression(field.expression, process.name, edge.place)


def test_the_templates_and_the_words_know_the_same_events():
    """Every event in a template has a known name."""
    comment = re.compile(r'kind="comments"[^>]*>(.*?)</label>')
    known = {
        annotation.key
        for template in PROFILES.rglob('*.j2')
        for text in comment.findall(template.read_text(encoding='utf-8'))
        for branch in (r'\1', r'\2')
        if (annotation := read_annotation(CHOICE.sub(branch, text)))
    }
    assert known == set(WORDS)


def test_an_await_names_what_it_was_for_when_it_began():
    annotation = read_annotation(
        'event await; needed: callback awaited() before; thread: thread id'
    )
    assert annotation is not None
    assert annotation.fields == (
        FieldText('needed', 'callback', 'awaited()', True),
        FieldText('thread', 'thread', 'id', False),
    )


@pytest.mark.parametrize('comment', ['', 'eventually', 'event of mine; so be it', '{thread id}'])
def test_what_is_no_annotation_is_left_alone(comment: str):
    assert read_annotation(comment) is None
