"""
Texts of XML and YAML launch files, with their substitutions ``$(name arguments)``.

Source: launch (Jazzy) ``frontend/parse_substitution.py`` and its grammar: arguments are divided by
blanks, may be quoted, and may hold further substitutions.
"""

from __future__ import annotations

from ros2cc_extract.extract.launch.language.substitutions import (
    Configuration,
    Evaluated,
    Expression,
    Logic,
    Share,
    Substitution,
    Text,
    ThisFile,
    Unresolved,
    Variable,
)
from ros2cc_extract.source_locations import Place, Unknown

_DEEPEST = 20
_LOGIC = ('not', 'and', 'or', 'equals', 'not-equals', 'any', 'all', 'if')
_AS = {'any': 'or', 'all': 'and'}


def parsed(text: str, place: Place) -> Expression:
    """The expression that a text stands for."""
    return _Reader(text, place).whole()


class _Reader:
    def __init__(self, text: str, place: Place) -> None:
        self._text = text
        self._place = place
        self._at = 0
        self._depth = 0

    def whole(self) -> Expression:
        return tuple(self._until(''))

    def _until(self, ends: str) -> list[Substitution]:
        """Read up to one of the characters ``ends``, or to the end of the text."""
        found: list[Substitution] = []
        plain = ''
        while self._at < len(self._text) and self._text[self._at] not in ends:
            if self._text.startswith('$(', self._at):
                if plain:
                    found.append(Text(plain))
                plain = ''
                self._at += 2
                found.append(self._substitution())
                continue
            if self._text[self._at] == '\\' and self._at + 1 < len(self._text):
                self._at += 1
            plain += self._text[self._at]
            self._at += 1
        if plain:
            found.append(Text(plain))
        return found

    def _substitution(self) -> Substitution:
        self._depth += 1
        words: list[Expression] = []
        while self._at < len(self._text) and self._text[self._at] != ')':
            if self._text[self._at].isspace():
                self._at += 1
            elif self._depth > _DEEPEST:
                self._at = len(self._text)
            else:
                words.append(self._word())
        self._at += 1
        self._depth -= 1
        return self._made(words)

    def _word(self) -> Expression:
        quote = self._text[self._at]
        if quote not in '\'"':
            return tuple(self._until(' \t\n)'))
        self._at += 1
        found = self._until(quote)
        self._at += 1
        return tuple(found)

    def _made(self, words: list[Expression]) -> Substitution:
        name = words[0][0].text if words and words[0] and isinstance(words[0][0], Text) else ''
        arguments = words[1:]
        if name in _LOGIC and arguments:
            return Logic(_AS.get(name, name), tuple(arguments))
        if name in ('dirname', 'filename'):
            return ThisFile(is_folder=name == 'dirname')
        if not arguments:
            return Unresolved(Unknown(f'substitution $({name})', self._place))
        default = arguments[1] if len(arguments) > 1 else None
        if name == 'var':
            return Configuration(arguments[0], default)
        if name in ('env', 'optenv'):
            return Variable(arguments[0], default)
        if name == 'find-pkg-share':
            return Share(arguments[0])
        if name == 'eval':
            joined = [part for word in arguments for part in (*word, Text(' '))]
            return Evaluated(tuple(joined[:-1]))
        return Unresolved(Unknown(f'substitution $({name} …) is known at the launch', self._place))
