"""Which domains may be used is said in the environment."""

from __future__ import annotations

import pytest

from ros2cc_extract.confirm import processes
from ros2cc_extract.errors import InputError


def test_only_the_domains_that_are_named_are_used(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(processes.DOMAINS_VARIABLE, '61-62')
    with processes._domain() as first, processes._domain() as second:
        assert {first, second} == {61, 62}
        with pytest.raises(InputError, match='all domains of ROS are in use'):
            processes._domain().__enter__()


@pytest.mark.parametrize('text', ['x', '5', '9-3', '1-233', '-4', '1-2-3'])
def test_what_names_no_domains_is_refused(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(processes.DOMAINS_VARIABLE, text)
    with pytest.raises(InputError, match='names no domains'):
        processes._domain().__enter__()
