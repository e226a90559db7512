import re
from xml.etree import ElementTree

import pytest
from generator_units import closed_unit, every_text

from ros2cc_extract.checker.api import read_model
from ros2cc_extract.generator.build import Text, render

ARM = closed_unit('tick:TMR:a scan:SUB:b', 'a:EXCLUSIVE b:REENTRANT', 2)
TEXTS = every_text('tick:TMR:a scan:SUB:b', 'a:EXCLUSIVE b:REENTRANT')
REFERENCE = re.compile(r'\{(?:(?:callback|thread|group) ([^{}]+)|executor)\}')


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
        '{callback my_cb_id} starts on {thread id}',
        '{callback my_cb_id} ends on {thread id}',
    ]


def test_groups_and_callbacks_tell_their_changes():
    xml = render(ARM).xml
    assert narration(xml, 'CallbackGroup') == [
        'group {group id} closes',
        'group {group id} opens',
    ]
    assert narration(xml, 'Callback') == [
        '{callback id} becomes ready',
        '{callback id} is no longer ready',
    ]


def test_executor_tells_its_decisions():
    assert narration(render(ARM).xml, 'Executor') == [
        '{executor} polls which callbacks are ready',
        '{executor} waits: all threads are busy',
        '{executor} goes on: {thread cur_thread_id} is idle',
        '{executor} assigns {callback cur_cb_id} to {thread cur_thread_id}',
        '{executor} passes over {callback cur_cb_id}: not ready, or its group is closed',
    ]


def test_the_compact_executor_says_why_it_passes_over_a_callback():
    assert narration(render(ARM, text=Text.COMPACT).xml, 'Executor') == [
        '{executor} assigns {callback cur_cb_id - 1} to {thread lowest_idle_thread()}',
        '{executor} passes over {callback cur_cb_id - 1}: it is not ready',
        '{executor} passes over {callback cur_cb_id - 1}: its group is closed',
        '{executor} polls which callbacks are ready',
        '{executor} polls and sees {callback watched_cb_id} ready',
    ]


@pytest.mark.parametrize('text', TEXTS)
def test_every_sentence_can_be_told(text: str):
    """Each brace is a reference whose expression the checker evaluates in its process."""
    model = read_model(TEXTS[text], 'arm.xml')
    for process in model.network.processes:
        for edge in process.edges:
            assert '{' not in REFERENCE.sub('', edge.comment), edge.comment
            for expression in filter(None, REFERENCE.findall(edge.comment)):
                model.elaboration.expression(expression, process.name, edge.place)
