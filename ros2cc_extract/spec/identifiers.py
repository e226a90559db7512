"""
Names that UPPAAL accepts, and how an extracted name is mended into one.

Keywords: UPPAAL documentation, page "Reserved Keywords" (5.0); predefined names of the
published declarations are reserved as well, because a callback of that name would break the model.
"""

from __future__ import annotations

import re
from collections.abc import Collection

_IDENTIFIER = re.compile(r'[A-Za-z_][A-Za-z0-9_]*\Z')
_OTHER = re.compile(r'[^A-Za-z0-9_]+')

KEYWORDS = frozenset(
    'after_update and assert assign before_update bool break broadcast case chan clock commit '
    'const continue control default deadlock do double dynamic else enum false for foreach '
    'forall exists sum hybrid if imply import init inf int int8_t int16_t int32_t INT8_MIN '
    'INT8_MAX UINT8_MAX INT16_MIN INT16_MAX UINT16_MAX INT32_MIN INT32_MAX location meta not '
    'or priority probability process progress query rate ref return scalar select simulate '
    'state string strategy struct sup switch sync system trans true typedef typename U uint8_t '
    'uint16_t urgent void while xor spawn exit numOf min max bounds A E M R W X G F '
    'E_loadStrategy saveStrategy loadStrategy gantt IO refinement consistency specification '
    'implementation acontrol scenario under template quit int_t'.split()
)

MODEL_NAMES = frozenset(
    'NUM_CB NUM_CB_GROUP NUM_THREAD MAX_CYCLE CbId GroupId ThreadId CbType GroupType TMR SUB SRV '
    'CLT REENTRANT EXCLUSIVE cb_group_table cb_type_table group_closed group_close group_open '
    'ready_set cb_assign_signal thread_free thread_running thread_cb_assign_table cb_running '
    'get_thread_running_cb get_thread_running_group Callback CallbackGroup Thread Executor'.split()
)

RESERVED = KEYWORDS | MODEL_NAMES


def complaint(name: str) -> str | None:
    """Say why ``name`` cannot name a process of the model, ``None`` when it can."""
    if not _IDENTIFIER.match(name):
        return f'{name!r} is no UPPAAL identifier'
    if name in KEYWORDS:
        return f'{name!r} is a UPPAAL keyword'
    if name in MODEL_NAMES:
        return f'{name!r} is a name of the model itself'
    return None


def mend(text: str, taken: Collection[str] = ()) -> str:
    """Make ``text`` a usable name that is not in ``taken``: ``2nd scan`` -> ``_2nd_scan``."""
    name = _OTHER.sub('_', text).strip('_') or 'unnamed'
    if name[0].isdigit():
        name = f'_{name}'
    if name in RESERVED:
        name = f'{name}_'
    candidate, number = name, 2
    while candidate in taken:
        candidate, number = f'{name}_{number}', number + 1
    return candidate
