"""
XML and YAML launch files: their elements as actions.

Source: launch (Jazzy) ``frontend/``, ``actions/`` and launch_ros ``actions/`` (the ``parse`` of
each action); names with ``-`` and ``_`` are the same.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from ros2cc_extract.extract.launch.language.actions import (
    LIST_OF,
    Action,
    ChangeState,
    Condition,
    Declare,
    FromFile,
    Given,
    Group,
    Include,
    Listed,
    ParameterSource,
    PushNamespace,
    PushParameters,
    PushRemap,
    SetConfiguration,
    StartNode,
    StartProcess,
    Unfollowed,
)
from ros2cc_extract.extract.launch.language.recognition import XML
from ros2cc_extract.extract.launch.language.substitutions import Expression, Text
from ros2cc_extract.extract.launch.markup.elements import Element, read_xml, read_yaml
from ros2cc_extract.extract.launch.markup.texts import parsed
from ros2cc_extract.files import Files
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.system.launched import TIMER

_MOST_BYTES = 1_000_000
_SUBSTITUTION = '$('
_HARMLESS = frozenset(
    """
    log log_info set_env unset_env append_env reset_env shutdown reset
    let_env on_exit ros_log_dir arg_env
    """.split()  # noqa: SIM905
)


def read_frontend(path: Path, shown: str, files: Files) -> Sequence[Action]:
    """The actions of an XML or YAML launch file."""
    place = Place(shown, 1, 1)
    try:
        data = files.read(path, _MOST_BYTES)
    except OSError as error:
        return [Unfollowed(place=place, why=Unknown(f'cannot be read: {error.strerror}'))]
    root = read_xml(data, shown) if path.suffix in (XML, '.launch') else read_yaml(data, shown)
    if isinstance(root, Unknown):
        return [Unfollowed(place=root.at or place, why=root)]
    if root.name != 'launch':
        why = Unknown(f'its root is {root.name}, not launch')
        return [Unfollowed(place=place, why=why)]
    return _all(root.children)


def _all(elements: Iterable[Element]) -> list[Action]:
    return [action for element in elements for action in _one(element)]


def _one(element: Element) -> list[Action]:
    name = element.name.replace('-', '_')
    if name in _HARMLESS:
        return []
    maker = _MAKERS.get(name)
    if maker is None:
        why = Unknown(f'element {element.name!r} is not known')
        return [Unfollowed(place=element.place, why=why)]
    return [replace(maker(element), condition=_condition(element))]


def _condition(element: Element) -> Condition | None:
    for operator in ('if', 'unless'):
        if operator in element.attributes:
            return Condition(operator, (_attribute(element, operator) or (),))
    return None


def _attribute(element: Element, *names: str) -> Expression | None:
    given = next((element.attributes[n] for n in names if n in element.attributes), None)
    return None if given is None else parsed(given, element.place)


def _required(element: Element, *names: str) -> Expression:
    found = _attribute(element, *names)
    return (Text(''),) if found is None else found


def _node(kind: str) -> Callable[[Element], Action]:
    def make(element: Element) -> Action:
        arguments = [_attribute(element, name) for name in ('args', 'ros_args', 'ros_arguments')]
        given = [arguments[0], *((Text('--ros-args '), *each) for each in arguments[1:] if each)]
        loaded = [each for child in element.all('composable_node') for each in _one(child)]
        if _attribute(element, 'autostart') is not None:
            loaded.append(ChangeState(place=element.place))
        return StartNode(
            place=element.place,
            kind=kind,
            package=_attribute(element, 'pkg'),
            executable=_attribute(element, 'exec', 'plugin'),
            name=_attribute(element, 'name'),
            namespace=_attribute(element, 'namespace'),
            remaps=tuple(
                (_required(each, 'from'), _required(each, 'to')) for each in element.all('remap')
            ),
            parameters=tuple(_parameters(element.all('param'), ())),
            arguments=tuple(each for each in given if each is not None),
            loaded=tuple(loaded),
        )

    return make


def _parameters(elements: Iterable[Element], prefix: Expression) -> list[ParameterSource]:
    found: list[ParameterSource] = []
    for element in elements:
        path = _attribute(element, 'from')
        if path is not None:
            found.append(FromFile(path, element.place))
            continue
        name = (*prefix, *_required(element, 'name'))
        nested = element.all('param')
        if nested:
            found += _parameters(nested, (*name, Text('.')))
        else:
            found.append(Given(name, _value(element), element.place, _kind(element)))
    return found


def _value(element: Element) -> Listed | Expression:
    """A value, or a list: one of YAML, or a text that ``value-sep`` divides."""
    separator = element.attributes.get('value-sep')
    items = element.lists.get('value')
    if items is None and separator:
        items = element.attributes.get('value', '').split(separator)
    if items is None:
        return _required(element, 'value')
    return Listed(tuple(parsed(item, element.place) for item in items))


def _kind(element: Element) -> str:
    """The type that is written, or that of a text in quotes; what substitutions give is read."""
    items = element.lists.get('value')
    written = [element.attributes.get('value', '')] if items is None else items
    is_text = 'value' in element.texts and not any(_SUBSTITUTION in each for each in written)
    of_yaml = ('str' if items is None else f'{LIST_OF}str') if is_text else ''
    return element.attributes.get('type', of_yaml)


def _declare(element: Element) -> Action:
    default = _attribute(element, 'default')
    return Declare(place=element.place, name=_required(element, 'name'), default=default)


def _let(element: Element) -> Action:
    return SetConfiguration(
        place=element.place, name=_required(element, 'name'), value=_required(element, 'value')
    )


def _unset(element: Element) -> Action:
    return SetConfiguration(place=element.place, name=_required(element, 'name'), value=None)


def _include(element: Element) -> Action:
    pairs = tuple(
        (_required(each, 'name'), _required(each, 'value')) for each in element.all('arg', 'let')
    )
    return Include(place=element.place, path=_required(element, 'file'), arguments=pairs)


def _group(element: Element) -> Action:
    scoped = element.attributes.get('scoped', 'true').lower() not in ('false', '0')
    keeps = [child for child in element.children if child.name != 'keep']
    return Group(place=element.place, actions=tuple(_all(keeps)), scoped=scoped)


def _timer(element: Element) -> Action:
    inner = tuple(_all(element.children))
    return Group(place=element.place, actions=inner, scoped=False, later=TIMER)


def _load(element: Element) -> Action:
    return Group(place=element.place, actions=tuple(_all(element.all('composable_node'))))


def _push(element: Element) -> Action:
    return PushNamespace(place=element.place, namespace=_required(element, 'namespace'))


def _remap(element: Element) -> Action:
    old, new = _required(element, 'from'), _required(element, 'to')
    return PushRemap(place=element.place, old=old, new=new)


def _parameter(element: Element) -> Action:
    given = Given(_required(element, 'name'), _required(element, 'value'), element.place)
    return PushParameters(place=element.place, parameters=(given,))


def _parameter_file(element: Element) -> Action:
    given = FromFile(_required(element, 'filename'), element.place)
    return PushParameters(place=element.place, parameters=(given,))


def _sim_time(element: Element) -> Action:
    given = Given((Text('use_sim_time'),), _required(element, 'value'), element.place)
    return PushParameters(place=element.place, parameters=(given,))


def _change_state(element: Element) -> Action:
    return ChangeState(place=element.place)


def _process(element: Element) -> Action:
    return StartProcess(place=element.place, command=(_required(element, 'cmd'),))


_MAKERS: dict[str, Callable[[Element], Action]] = {
    'arg': _declare,
    'let': _let,
    'unset': _unset,
    'node': _node('node'),
    'lifecycle_node': _node('lifecycle'),
    'node_container': _node('container'),
    'composable_node': _node('composable'),
    'load_composable_node': _load,
    'executable': _process,
    'include': _include,
    'group': _group,
    'push_ros_namespace': _push,
    'set_remap': _remap,
    'set_parameter': _parameter,
    'set_parameters_from_file': _parameter_file,
    'set_use_sim_time': _sim_time,
    'timer': _timer,
    'ros_timer': _timer,
    'lifecycle_transition': _change_state,
    'emit_event': _change_state,
}
