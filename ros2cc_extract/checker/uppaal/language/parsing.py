"""
Parses the texts of a model with lark.
"""

from __future__ import annotations

import functools
import re
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2cc_extract.checker.uppaal.language import syntax
from ros2cc_extract.checker.uppaal.language.precedence import MAX_DEPTH, NestingError
from ros2cc_extract.checker.uppaal.language.query_shapes import Maker, maker_of, shape_of
from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.source_locations import Place

if TYPE_CHECKING:
    from lark import Lark
    from lark.exceptions import UnexpectedInput

MEND_SUBSET = 'docs/checker.md lists the supported subset'
_OUTSIDE = {
    'priority': 'channel priorities',
    'progress': 'progress measures',
    'gantt': 'Gantt charts',
    'before_update': 'before_update',
    'after_update': 'after_update',
    'import': 'external functions',
    'process': 'textual processes',
    'struct': 'structs',
    'sup': 'sup queries',
    'inf': 'inf queries',
    'bounds': 'bounds queries',
    'Pr': 'statistical queries',
    'simulate': 'statistical queries',
    'control': 'game queries',
    'strategy': 'strategies',
    'spawn': 'dynamic templates',
    'dynamic': 'dynamic templates',
    'assert': 'assertions',
    'switch': 'switch statements',
    'under': 'strategies',
    '.': 'floating-point numbers',
    "'": 'clock rates',
}


_BEYOND = 'outside the supported subset of UPPAAL'
_WORD = re.compile(r'\w+|\S')
_PROCESSES = re.compile(r'\bsystem\b[^;]*\Z')
_LAST_WORD = re.compile(r'(\w+|\S)\s*$')


class Start(Enum):
    """What a text is; the values are rules of the grammar."""

    DECLARATIONS = 'declarations'
    SYSTEM = 'system'
    PARAMETERS = 'parameters'
    SELECTS = 'selects'
    UPDATES = 'updates'
    CONDITION = 'condition'
    QUERY = 'query'


@functools.cache
def _parser() -> Lark:
    # Imported late: commands that read no model start faster without.
    from ros2cc_extract.checker.uppaal.language.parse_tables import Grammar
    from ros2cc_extract.checker.uppaal.language.tree_builder import TreeBuilder

    text = Path(__file__).with_name('grammar.lark').read_text('utf-8')
    return Grammar(text, tuple(start.value for start in Start)).parser(TreeBuilder())


def parse(text: str, start: Start, place: Place) -> Any:
    """
    Parse one text of a model.

    :param place: where the text starts; every line in the result is a line of that file.
    :return: what the ``TreeBuilder`` method named like ``start`` returns.
    :raises ModelFormatError: a syntax error, or too deep nesting.
    """
    from lark.exceptions import UnexpectedInput, VisitError

    try:
        return _tree(text, start, place.line)
    except UnexpectedInput as error:
        raise _syntax_error(error, text, place) from None
    except NestingError as error:
        raise _nesting_error(error, place) from None
    except VisitError as error:
        if isinstance(error.orig_exc, NestingError):
            raise _nesting_error(error.orig_exc, place) from None
        raise


@functools.lru_cache(maxsize=4096)
def _tree(text: str, start: Start, line: int) -> Any:
    # Trees are values without the file's name; models of one sweep share most of their texts.
    return _parser().parse('\n' * (line - 1) + text, start=start.value)


def _nesting_error(error: NestingError, place: Place) -> ModelFormatError:
    return ModelFormatError(
        f'the text nests deeper than {MAX_DEPTH}',
        Place(place.file, error.line or place.line),
        'split the expression or statement',
    )


def _syntax_error(error: UnexpectedInput, text: str, place: Place) -> ModelFormatError:
    from lark.exceptions import UnexpectedToken

    if isinstance(error, UnexpectedToken) and error.token.type == '$END':
        last = place.line + text.rstrip().count('\n')
        what = 'syntax error: the text ends too early'
        return ModelFormatError(what, Place(place.file, last), 'complete it')
    at = Place(place.file, error.line)
    line = text.split('\n')[error.line - place.line]
    before, rest = line[: error.column - 1], line[error.column - 1 :]
    found = _WORD.match(rest)
    word = found[0] if found else 'end of line'
    previous = _LAST_WORD.search(before)
    first = _WORD.match(line.lstrip())
    if rest.startswith('/*'):
        return ModelFormatError('a comment is not closed', at, 'close it with */')
    if before.endswith('*') and rest.startswith('*'):
        return ModelFormatError(f'the power operator ** is {_BEYOND}', at, 'multiply')
    suspects = [found, previous, first]
    for suspect in (match[0].strip() for match in suspects if match):
        if suspect in _OUTSIDE:
            what = f'{_OUTSIDE[suspect]} are {_BEYOND}'
            return ModelFormatError(what, at, MEND_SUBSET)
    if word == '<' and _is_in_system_line(text, error.line - place.line, before):
        return ModelFormatError(f'process priorities are {_BEYOND}', at, 'separate by commas')
    if word == '"':
        return ModelFormatError(f'strings are {_BEYOND}', at, MEND_SUBSET)
    return ModelFormatError(f'syntax error at {word!r}', at, 'correct the text there')


def _is_in_system_line(text: str, lines: int, before: str) -> bool:
    """Whether processes are listed there, over as many lines as it takes."""
    read = '\n'.join((*text.split('\n')[:lines], before))
    return bool(_PROCESSES.search(read))


def parse_query(text: str, place: Place) -> syntax.Query:
    """Parse one query."""
    shape, numbers = shape_of(text)
    try:
        result = _query_maker(shape, place.line)(numbers)
    except ModelFormatError:
        result = parse(text, Start.QUERY, place)  # its error shows the text as it was given
    assert isinstance(result, syntax.Query)
    return result


@functools.lru_cache(maxsize=4096)
def _query_maker(shape: str, line: int) -> Maker:
    return maker_of(parse(shape, Start.QUERY, Place('query', line)))
