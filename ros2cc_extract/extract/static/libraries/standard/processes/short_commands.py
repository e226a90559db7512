"""
Commands that end at once: a program that waits for one hardly waits.

Sources: POSIX.1-2017, *Utilities*; the manual pages of coreutils 9, procps-ng 4, psmisc 23,
util-linux 2.38, alsa-utils 1.2, pulseaudio 16, WirePlumber 0.4, v4l-utils 1.22, systemd 252
(``shutdown(8)``), X.org (``xset``, ``xrandr``). Left out is what reads its standard input where
it gets no file, what asks another machine, and what lasts as long as its work.
"""

from __future__ import annotations

import shlex

from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import Call, Const, Value, options_of

_NAMES = """
arch basename chgrp chmod chown date df dirname echo expr false getconf getent groups hostname
hostnamectl id kill killall link ln logname ls lsblk lscpu lsmod lspci lsusb mkdir mkfifo mktemp
mv nproc pathchk pgrep pidof pkill printenv printf ps pwd readlink realpath renice rm rmdir stat
stty tput true touch tty type uname unlink uptime which whoami
halt poweroff reboot shutdown
amixer pactl v4l2-ctl vcgencmd wpctl xrandr xset
ip iw iwgetid rfkill
"""
_SHORT = frozenset(_NAMES.split())
_UNLESS = {
    'ip': ('monitor',),
    'iw': ('event', 'scan'),
    'killall': ('-w', '--wait'),
    'pactl': ('subscribe',),
    'rfkill': ('event',),
    'shutdown': ('-k',),
    'v4l2-ctl': ('--stream', '--wait-for-event', '--poll-for-event', '--sleep'),
}
"""Words with which such a command lasts."""
_SEVERAL = frozenset({'&&', '||', ';', '|'})
_OF_SHELL = frozenset('`$<(){}*?\n')
"""What makes a text more than the names and words of commands."""

CALLS = {
    'subprocess.run': 'args',
    'subprocess.call': 'args',
    'subprocess.check_call': 'args',
    'subprocess.check_output': 'args',
    'subprocess.getoutput': 'cmd',
    'subprocess.getstatusoutput': 'cmd',
    'os.system': 'command',
}
"""The calls that start a command and wait for it, and how their command is called."""


def is_short(name: str, call: Call) -> bool:
    """Whether ``call`` of the library function ``name`` starts commands that end at once."""
    given = call.argument(0, CALLS[name]) if name in CALLS else None
    options = options_of(given) if given is not None else ()
    return bool(options) and all(_ends_at_once(each) for each in options)


def _ends_at_once(command: Value) -> bool:
    if isinstance(command, Sequence):
        words = [{_text(one) for one in options_of(item)} for item in command.items]
        return command.others is None and _is_one_short(words)
    text = _text(command)
    return text is not None and all(_is_one_short(words) for words in _commands_in(text))


def _text(value: Value) -> str | None:
    return value.value if isinstance(value, Const) and isinstance(value.value, str) else None


_Words = list[set[str | None]]
"""What each word of a command may be."""


def _is_one_short(words: _Words) -> bool:
    """Whether the program is known, and no word makes it wait; other words may be unknown."""
    names = {(name or '').rpartition('/')[2] for name in words[0]} if words else {''}
    lasting = tuple(word for name in names for word in _UNLESS.get(name, ()))
    others = {word for each in words[1:] for word in each if word is not None}
    return names <= _SHORT and not any(word.startswith(lasting) for word in others)


def _commands_in(text: str) -> list[_Words]:
    """The commands of a line of the shell; an unknown one, if there is more in it."""
    unknown: list[_Words] = [[]]
    if _OF_SHELL & set(text):
        return unknown
    reader = shlex.shlex(text, posix=True, punctuation_chars='&|;>')
    reader.whitespace_split = True
    found: list[_Words] = [[]]
    try:
        for word in reader:
            if word in _SEVERAL:
                found.append([])
            elif word.startswith(('&', '|', ';')):
                return unknown
            else:
                found[-1].append({word})
    except ValueError:
        return unknown
    return [words for words in found if words] or unknown
