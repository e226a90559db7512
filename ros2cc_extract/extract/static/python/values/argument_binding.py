"""Whether the arguments of a call fit the parameters of a function."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.values.values import Call, Function


def fits(function: Function, call: Call) -> bool:
    """Whether Python takes the call, as far as it is known; else it raises ``TypeError``."""
    if call.more is not None:
        return True
    arguments = function.node.args
    names = [parameter.arg for parameter in (*arguments.posonlyargs, *arguments.args)]
    by_name = {parameter.arg for parameter in (*arguments.args, *arguments.kwonlyargs)}
    if len(call.args) > len(names) and arguments.vararg is None:
        return False
    if not by_name.issuperset(call.keywords) and arguments.kwarg is None:
        return False
    given = {*names[: len(call.args)], *call.keywords}
    needed = names[: len(names) - len(arguments.defaults)]
    needed += [
        parameter.arg
        for parameter, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
        if default is None
    ]
    return given.issuperset(needed)


def sources_of(function: Function, call: Call) -> dict[str, frozenset[str]]:
    """The shared data behind the parameters of a function, as in ``Call.sources``."""
    arguments = function.node.args
    names = [parameter.arg for parameter in (*arguments.posonlyargs, *arguments.args)]
    return {
        names[at] if isinstance(at, int) else at: sources
        for at, sources in call.sources.items()
        if isinstance(at, str) or at < len(names)
    }
