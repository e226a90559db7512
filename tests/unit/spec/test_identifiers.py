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
        ('M_PI', 'M_PI_'),
        ('DBL_MAX', 'DBL_MAX_'),
        ('UINT16_MAX', 'UINT16_MAX_'),
        ('int32_t', 'int32_t_'),
        ('a' * 5000, 'a' * 200),
    ],
)
def test_mended_names_are_usable(text: str, name: str) -> None:
    assert mend(text) == name
    assert complaint(mend(text)) is None


def test_mended_names_are_unique() -> None:
    assert mend('tick', {'tick', 'tick_2'}) == 'tick_3'


def test_long_names_that_begin_alike_stay_two() -> None:
    first = mend('a' * 4000 + 'b')
    assert mend('a' * 4000 + 'c', {first}) == f'{first}_2'


def test_what_uppaal_declares_and_what_is_too_long_is_refused_by_hand() -> None:
    assert complaint('FLT_MAX') == "'FLT_MAX' is declared by UPPAAL itself"
    assert complaint('a' * 255) is None
    assert complaint('a' * 256) == f"'{'a' * 20}'… has 256 characters, and 255 are allowed"


def test_a_word_of_the_query_grammar_is_allowed_by_hand() -> None:
    assert complaint('control') is None
    assert mend('control') == 'control_'
