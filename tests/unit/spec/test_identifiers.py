"""Names that break a model are mended when extracted and refused when written by hand."""

from __future__ import annotations

import pytest

from ros2cc_extract.spec.identifiers import complaint, mend


@pytest.mark.parametrize(
    ('text', 'name'),
    [
        ('on_scan', 'on_scan'),
        ('2nd scan', '_2nd_scan'),
        ('<lambda>', 'lambda'),
        ('clock', 'clock_'),
        ('TMR', 'TMR_'),
        ('A', 'A_'),
        ('log', 'log_'),
        ('exit', 'exit_'),
        ('X', 'X_'),
        ('größe', 'gr_e'),
        ('!?', 'unnamed'),
        ('_tick', '_tick'),
        ('__on', '__on'),
        ('~/image', 'image'),
    ],
)
def test_mended_names_are_usable(text: str, name: str) -> None:
    assert mend(text) == name
    assert complaint(mend(text)) is None


def test_mended_names_are_unique() -> None:
    assert mend('tick', {'tick', 'tick_2'}) == 'tick_3'


def test_a_word_of_the_query_grammar_is_allowed_by_hand() -> None:
    assert complaint('control') is None
    assert mend('control') == 'control_'
