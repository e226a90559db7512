"""Parameters that a launch sets before the code of a node runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from ros2cc_extract.light_dataclasses import dataclass


@dataclass(frozen=True)
class GivenParameters:
    """
    The values that nodes find.

    :param values: by name.
    :param are_all: what is not among them has its default, since nothing else sets any.
    """

    values: Mapping[str, object] = field(default_factory=dict)
    are_all: bool = False

    @property
    def key(self) -> str:
        """Equal where nothing differs."""
        return f'{sorted(self.values.items())!r} {self.are_all}' if self != NONE_GIVEN else ''


NONE_GIVEN = GivenParameters()
