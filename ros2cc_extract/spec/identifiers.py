"""
Names that UPPAAL accepts, and how an extracted name is mended into one.

Keywords: docs.uppaal.org, page "Reserved Keywords"; and what UPPAAL 5 has beyond it, the built-in
functions of the page "Expressions" among them, as its parser knows them
(github.com/UPPAALModelChecker/utap, ``keywords.cpp``). Constants and types that it declares by
itself: the same page, "A few common constants and types" (built-in since Stratego 10). The names
that the published declarations define are reserved as well, because a callback of such a name
would break the model.
"""

from __future__ import annotations

import re
from collections.abc import Collection

_IDENTIFIER = re.compile(r'[A-Za-z_][A-Za-z0-9_]*\Z')
_OTHER = re.compile(r'[^A-Za-z0-9_]+')
_EDGES = re.compile(r'\A[^A-Za-z0-9_]+|[^A-Za-z0-9_]+\Z')

_KEYWORD_TEXT = """
chan clock double bool int commit const urgent broadcast init process state invariant location
guard sync assign system trans deadlock and or not imply true false for forall while do if else
return typedef struct rate before_update after_update meta priority progress scalar select void
default string minE maxE Pr switch case continue break enum exists sum
xor probability branchpoint import gantt assert IO hybrid dynamic spawn exit numOf foreach query
abs fabs fmod fma fmax fmin fdim exp exp2 expm1 ln log log10 log2 log1p pow sqrt cbrt hypot
sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh erf erfc tgamma lgamma
ceil floor trunc round fint ldexp ilogb logb nextafter copysign
fpclassify isfinite isinf isnan isnormal signbit isunordered
random random_arcsine random_beta random_gamma random_normal random_poisson random_tri
random_weibull
"""

# All that UPPAAL declares before a model: a second declaration is refused.
_BUILT_IN_TEXT = """
INT8_MIN INT8_MAX UINT8_MAX INT16_MIN INT16_MAX UINT16_MAX INT32_MIN INT32_MAX
int8_t uint8_t int16_t uint16_t int32_t FLT_MIN FLT_MAX DBL_MIN DBL_MAX
M_PI M_PI_2 M_PI_4 M_E M_LOG2E M_LOG10E M_LN2 M_LN10 M_1_PI M_2_PI M_2_SQRTPI M_SQRT2 M_SQRT1_2
"""

# Words of the query grammar alone: they break a query that names the process, not the model.
_QUERY_WORD_TEXT = """
A E U W R M X inf sup bounds control control_t simulate simulation strategy under imitate sat
loadStrategy saveStrategy Pmax minPr maxPr
"""

_MODEL_NAME_TEXT = """
NUM_CB NUM_CB_GROUP NUM_THREAD MAX_CYCLE CbId GroupId ThreadId CbType GroupType TMR SUB SRV
CLT REENTRANT EXCLUSIVE cb_group_table cb_type_table group_closed group_close group_open
ready_set cb_assign_signal thread_free thread_popped thread_running thread_cb_assign_table
cb_running get_thread_running_cb get_thread_running_group NUM_NODE NUM_EVENT QUEUE_DEPTH NodeId
cb_node_table
cb_rank_table NUM_WAIT cb_wait_table cb_server_table cb_calls cb_asked cb_answers cb_ended
cb_arrive cb_is_answered cb_take_answer cb_await_table cb_suspended cb_await_at cb_can_resume
cb_sent cb_send cb_own_answers cb_freed cb_signal cb_overlooked cb_polled cb_awaited_table
gathering more_runs task_list task_count
task_place drop_task MAX_TASKS WaitId MAX_SUSPENDED MAX_QUEUED PoolEntry POOL_DEPTH cb_resuming
cb_unfinished CB_IN_PLAY num_cb_in_play related_in_play
cb_waiting cb_queued cb_runs cb_all_served pool_queue pool_size event_queue event_count hurry
NUM_READY ready_queue ready_count group_is_exclusive cb_is_serial cb_is_queued make_ready
Callback CallbackGroup Thread Executor
"""

KEYWORDS = frozenset(_KEYWORD_TEXT.split())
MODEL_NAMES = frozenset(_MODEL_NAME_TEXT.split())
QUERY_WORDS = frozenset(_QUERY_WORD_TEXT.split())
BUILT_INS = frozenset(_BUILT_IN_TEXT.split())
AVOIDED = KEYWORDS | MODEL_NAMES | QUERY_WORDS | BUILT_INS
#: UPPAAL refuses names of some 4,000 characters; file systems bear 255.
LONGEST = 255
_LONGEST_MENDED = 200


def complaint(name: str) -> str | None:
    """Say why ``name`` cannot name a process of the model, ``None`` when it can."""
    if not _IDENTIFIER.match(name):
        return f'{name!r} is no UPPAAL identifier'
    if len(name) > LONGEST:
        return f'{name[:20]!r}… has {len(name)} characters, and {LONGEST} are allowed'
    if name in KEYWORDS:
        return f'{name!r} is a UPPAAL keyword'
    if name in BUILT_INS:
        return f'{name!r} is declared by UPPAAL itself'
    if name in MODEL_NAMES:
        return f'{name!r} is a name of the model itself'
    return None


def complaint_of_executor(name: str) -> str | None:
    """Say why ``name`` cannot name the executor, the one process that queries name."""
    if name in QUERY_WORDS:
        return f'{name!r} is a word of UPPAAL queries, and queries name the executor'
    return complaint(name)


def mend(text: str, taken: Collection[str] = ()) -> str:
    """
    Make ``text`` a usable name that is not in ``taken``: ``2nd scan`` -> ``_2nd_scan``.

    Underscores of its own are kept: ``tick`` and ``_tick`` are two.
    """
    name = _OTHER.sub('_', _EDGES.sub('', text))[:_LONGEST_MENDED] or 'unnamed'
    if name[0].isdigit():
        name = f'_{name}'
    if name in AVOIDED:
        name = f'{name}_'
    candidate, number = name, 2
    while candidate in taken:
        candidate, number = f'{name}_{number}', number + 1
    return candidate
