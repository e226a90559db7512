"""In which order the text of a callback does things."""

from __future__ import annotations

from ros2cc_extract.places import Place
from ros2cc_extract.spec.deeds import Access, Act, Blocking


def steps(deed: Access | Act | Blocking) -> tuple[Place, ...]:
    """The way to a deed; ways of one callback are ordered as its text is, loops apart."""
    source = (deed.source,) if deed.source is not None else ()
    return (*deed.chain, *source)
