"""
Runs to step through: data that the script draws on demand.

A run that several parts show is stored once, and so is each of the few sentences, names and places
of which runs are made.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from html import escape
from typing import Any

from ros2cc_extract.report.html.parts import folded, span, tag
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.shared.run_endings import closing_lines
from ros2cc_extract.report.shared.run_lanes import Lane, Stay, lanes_of
from ros2cc_extract.report.shared.short_runs import shortened
from ros2cc_extract.report.text.spec import short
from ros2cc_extract.spec.display_names import display_names
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.evidence import Evidence, Moment

BLOCKED = 'blocked'
"""Location of a thread whose callback waits, in the models of profile ``rclpy``."""
MOST_STEPS = 8
"""Of a run as text; the script shows all."""
COLOURS = 8
IS_REST, IS_BLOCKED = 1, 2
Names = Mapping[str, str]


class Runs:
    """The runs of the page, collected while it is written."""

    def __init__(self) -> None:
        self._words: dict[str, int] = {}
        self._runs: dict[str, int] = {}

    def player(self, run: Evidence, unit: Spec | None, *, opened: bool = False) -> str:
        """Write what opens a run step by step."""
        number = self.number(run, unit)
        summary = f'step through {counted(len(run.moments), "steps")}'
        return folded(summary, class_='run', data_run=str(number), opened=opened)

    def number(self, run: Evidence, unit: Spec | None) -> int:
        """
        Store a run and give where it is found.

        :param unit: the unit of the run; it names its lanes as they are in the code.
        """
        callbacks = [each.name for each in unit.callbacks] if unit else []
        names = display_names(unit) if unit else {}
        colours = {name: number % COLOURS for number, name in enumerate(callbacks)}
        data = [
            [self._lane(lane, colours, names) for lane in lanes_of(run, callbacks)],
            [self._step(moment, run, names) for moment in run.moments],
            run.cycle_from,
            run.ends,
        ]
        return self._runs.setdefault(_json(data), len(self._runs))

    def data(self) -> str:
        """Everything that was stored, as JSON that can stand in a script element."""
        text = f'{{"words":{_json(list(self._words))},"runs":[{",".join(self._runs)}]}}'
        return text.replace('</', '<\\/').replace('<!', '<\\u0021')

    def _word(self, text: str) -> int:
        return self._words.setdefault(text, len(self._words))

    def _lane(self, lane: Lane, colours: Mapping[str, int], names: Names) -> list[Any]:
        stays = [self._stay(stay, lane, colours, names) for stay in lane.stays]
        return [self._word(names.get(lane.process, lane.process)), stays]

    def _stay(self, stay: Stay, lane: Lane, colours: Mapping[str, int], names: Names) -> list[Any]:
        doer = names.get(stay.callback, stay.callback) if stay.callback else ''
        text = f'{doer}: {stay.location}' if doer else stay.location
        marks = IS_REST * stay.is_rest + IS_BLOCKED * (stay.location == BLOCKED)
        colour = colours.get(stay.callback or lane.process)
        return [self._word(text), stay.since, stay.until, marks, colour]

    def _step(self, moment: Moment, run: Evidence, names: Names) -> list[Any]:
        changes = moment.changes.items()
        said = ((names.get(each.lane, each.lane), each.text) for each in moment.sentences)
        return [
            [[self._word(lane), self._word(text)] for lane, text in said],
            [self._word(str(place)) for _, place in moment.places],
            [self._word(f'{name} = {value}') for name, value in changes if name not in run.start],
        ]


def steps_as_text(run: Evidence) -> str:
    """Write the steps that say most, as the text report has them."""
    run = shortened(run, MOST_STEPS)
    steps = ''.join(_step_text(moment, run) for moment in run.moments)
    closing = ''.join(tag('p', escape(line), class_='closing') for line in closing_lines(run))
    return tag('ol', steps, class_='steps') + closing


def _step_text(moment: Moment, run: Evidence) -> str:
    said = '; '.join(sentence.text for sentence in moment.sentences)
    again = 'from here on, repeated forever: ' if moment.number == run.cycle_from else ''
    places = dict.fromkeys(short(place) for _, place in moment.places)
    return tag('li', escape(again + said), *(f' {span("place", place)}' for place in places))


def _json(data: object) -> str:
    return json.dumps(data, ensure_ascii=False, separators=(',', ':'))
