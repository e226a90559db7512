"""
The words of a command that XML and YAML launch files have as one text.

Source: launch (Jazzy) ``actions/execute_process.py`` (``_parse_cmdline``): texts are divided as a
shell does it, and what a substitution stands for is not.
"""

from __future__ import annotations

import shlex

from ros2cc_extract.extract.launch.language.substitutions import Expression, Text


def words_of(command: Expression) -> list[Expression]:
    """
    The words of ``command``, each an expression of its own.

    :raises ValueError: when a quotation is not closed, as launch does.
    """
    words: list[Expression] = []
    word: Expression = ()
    for part in command:
        if not isinstance(part, Text):
            word = (*word, part)
            continue
        tokens = [(Text(token),) for token in shlex.split(part.text)]
        if word and (not tokens or part.text[0].isspace()):
            words.append(word)
            word = ()
        if tokens:
            *whole, last = ((*word, *tokens[0]), *tokens[1:])
            words += whole
            word = last
            if part.text[-1].isspace():
                words.append(word)
                word = ()
    return [*words, word] if word else words
