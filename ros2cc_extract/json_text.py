"""JSON that a stranger may have written: read whole, or refused in one way."""

from __future__ import annotations

import json
from typing import Any


def read_json(text: str | bytes) -> Any:
    """
    Read one JSON value.

    :raises ValueError: ``JSONDecodeError`` with line and column where it is no JSON; also for
        numbers of more digits than Python reads and for nesting that is deeper than its stack.
    """
    try:
        return json.loads(text)
    except RecursionError:
        raise ValueError('it is nested too deeply') from None
