"""One unit's callbacks, groups and executor as values of the specification."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace

from ros2cc_extract.extract.names import Names, Wanted, unique_names
from ros2cc_extract.extract.static.naming import (
    FunctionFacts,
    constant_text,
    describe,
    snake_case,
)
from ros2cc_extract.extract.static.values import (
    Class,
    Const,
    Instance,
    Mystery,
    Path,
    Value,
)
from ros2cc_extract.extract.static.world import (
    EntityRef,
    EntityState,
    ExecutorState,
    SettableRef,
    Spin,
    World,
)
from ros2cc_extract.places import Place, Unknown
from ros2cc_extract.spec.identifiers import mend
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    Origin,
    Spec,
    Unresolved,
    When,
)

NO_EXECUTOR = 'no executor or spin found for this node'
ASSUMED_THREADS = 2

_ORDER = {
    EntityKind.TIMER: 0,
    EntityKind.SUBSCRIPTION: 1,
    EntityKind.GUARD_CONDITION: 2,
    EntityKind.SERVICE: 3,
    EntityKind.CLIENT: 4,
    EntityKind.ACTION_SERVER: 5,
    EntityKind.ACTION_CLIENT: 6,
    EntityKind.ACTION_EXECUTE: 7,
    EntityKind.DONE_CALLBACK: 8,
    EntityKind.TASK: 9,
}
_GROUPLESS = (EntityKind.ACTION_EXECUTE, EntityKind.DONE_CALLBACK, EntityKind.TASK)


class UnitBuilder:
    """Builds the specification of one executor with its nodes."""

    def __init__(
        self, world: World, executor: Instance | None, nodes: list[Instance], spin: Spin | None
    ) -> None:
        self._world = world
        self._executor = executor
        self._nodes = nodes
        self._spin = spin
        self._taken = Names()
        self._facts: list[Unresolved] = []
        self._node_names: dict[int, str] = {}
        self._group_names: dict[int, str] = {}
        self._branches_of: dict[int, dict[Place, set[int]]] = {}

    def build(self, entry: str | None) -> Spec:
        """The specification."""
        names = self._name_nodes()
        name = self._taken.take(names[0] if len(names) == 1 else _unit_label(names))
        threads = self._thread_names()
        entities = self._entities()
        facts = [self._facts_of(entity) for entity in entities]
        labels = unique_names(
            [self._wanted(e, f) for e, f in zip(entities, facts, strict=True)], self._taken
        )
        groups = self._groups(entities, labels)
        callbacks = [
            self._callback(entity, fact, label)
            for entity, fact, label in zip(entities, facts, labels, strict=True)
        ]
        self._note_open_ends()
        executor = self._executor_value(threads, entry)
        return Spec(
            name=name,
            callbacks=tuple(self._with_waits(callbacks, entities, executor)),
            groups=tuple(groups),
            executor=executor,
            origin=Origin.STATIC,
            nodes=tuple(names),
            sources=self._sources(entities),
            entry=entry,
            unresolved=tuple(self._facts),
        )

    def _name_nodes(self) -> list[str]:
        names = Names()
        for node in self._nodes:
            self._node_names[id(node)] = names.take(self._node_label(node))
        return list(self._node_names.values())

    def _node_label(self, node: Instance) -> str:
        state = node.state
        name = state.name
        text = constant_text(name)
        if text is not None:
            return text
        if isinstance(name, Mystery) and constant_text(name.default) is not None:
            return str(constant_text(name.default))
        if state.ghost is not None:
            return node.hint or 'node'
        label = snake_case(node.class_name)
        reason = 'node name could not be followed'
        at: Place | None = node.place
        if isinstance(name, Mystery):
            reason = f'node name {name.text}: {name.unknown.reason}'.replace(' :', ':')
            at = name.unknown.at or at
        elif name is None:
            reason = 'no call of Node.__init__ with a name is in sight'
        self._facts.append(
            Unresolved(subject=mend(label), fact='node_name', reason=reason, source=at)
        )
        return label

    def _thread_names(self) -> tuple[str, ...]:
        state = self._state()
        number = state.threads if state else 1
        number = ASSUMED_THREADS if number is None else number
        return tuple(self._taken.take(f'thread_{index}') for index in range(number))

    def _state(self) -> ExecutorState | None:
        state = self._executor.state if self._executor else None
        return state if isinstance(state, ExecutorState) else None

    def _entities(self) -> list[EntityState]:
        """Node by node, timers first, group-less work last; creation order within a kind."""
        position = {id(node): index for index, node in enumerate(self._nodes)}
        mine = [entity for node in self._nodes for entity in self._world.by_node.get(id(node), ())]
        return sorted(
            mine,
            key=lambda e: (
                e.kind in _GROUPLESS,
                position[id(e.node)],
                _ORDER.get(e.kind, 10),
                e.number,
            ),
        )

    def _facts_of(self, entity: EntityState) -> FunctionFacts:
        if entity.kind in (EntityKind.CLIENT, EntityKind.ACTION_CLIENT, EntityKind.ACTION_SERVER):
            return self._server_or_client_facts(entity)
        if entity.library is not None and entity.callback is None:
            label = entity.label or 'rate_timer'
            return FunctionFacts(label)
        return describe(entity.callback, entity.place)

    def _server_or_client_facts(self, entity: EntityState) -> FunctionFacts:
        key = self._key_text(entity) or 'unnamed'
        end = {
            EntityKind.CLIENT: 'client',
            EntityKind.ACTION_CLIENT: 'action_client',
            EntityKind.ACTION_SERVER: 'action_server',
        }[entity.kind]
        facts = [describe(callback, entity.place) for callback in entity.extra_callbacks]
        known = next((fact for fact in facts if fact.function), None)
        label = f'{key}_{end}' if key != 'unnamed' else end
        if known is None:
            return FunctionFacts(label)
        return FunctionFacts(label, known.function, known.defined, known.coroutine)

    def _key_text(self, entity: EntityState) -> str | None:
        text = constant_text(entity.key)
        if text is None and isinstance(entity.key, Mystery):
            text = constant_text(entity.key.default)
        return mend(text) if text else None

    def _wanted(self, entity: EntityState, facts: FunctionFacts) -> Wanted:
        node = self._node_names.get(id(entity.node)) if len(self._nodes) > 1 else None
        return Wanted(facts.label, self._key_text(entity), node)

    def _groups(self, entities: Sequence[EntityState], labels: list[str]) -> list[CallbackGroup]:
        """The groups in use, in order of first use by creation."""
        pairs = sorted(
            zip(entities, labels, strict=True),
            key=lambda pair: (pair[0].kind in _GROUPLESS, pair[0].number),
        )
        groups: list[CallbackGroup] = []
        for entity, label in pairs:
            if id(entity.group) in self._group_names:
                continue
            name = self._taken.take(self._group_label(entity, label))
            self._group_names[id(entity.group)] = name
            groups.append(self._group(entity.group, name))
        return groups

    def _group_label(self, entity: EntityState, label: str) -> str:
        state = entity.group.state
        if state.default:
            name = self._node_names.get(id(state.node))
            return f'{name or _plain_label(state.node)}_default'
        return entity.group.hint or f'{label}_group'

    def _group(self, group: Instance, name: str) -> CallbackGroup:
        state = group.state
        return CallbackGroup(
            name=name,
            type=state.type,
            default=state.default,
            node=self._node_names.get(id(state.node)) if state.node else None,
            groupless=state.groupless,
            library=state.library,
            cls=state.custom,
            count=state.count,
            unresolved=state.unresolved,
            source=None if state.default or state.groupless else group.place,
        )

    def _callback(self, entity: EntityState, facts: FunctionFacts, name: str) -> Callback:
        node = entity.node
        path = _beyond(entity.path, node.path)
        deeds = entity.deeds
        key, assumed = _key(entity.key)
        period, period_assumed = _period(entity.period)
        return Callback(
            name=name,
            type=entity.kind.published_type,
            group=self._group_names[id(entity.group)],
            entity=entity.kind,
            node=node.state.ghost or self._node_names[id(node)],
            function=facts.function,
            cls=node.class_name if isinstance(node.cls, Class) else None,
            key=key if entity.kind.key_name else None,
            period_s=period if entity.kind is EntityKind.TIMER else None,
            count=entity.count,
            when=entity.when,
            conditional=bool(path) or entity.when is When.CALLBACK,
            alternative=self._alternative(entity, path),
            coroutine=facts.coroutine,
            one_shot=entity.one_shot,
            destroyed=entity.destroyed,
            groupless=entity.kind in _GROUPLESS,
            library=entity.library,
            builtin=entity.builtin,
            unresolved=facts.unresolved if entity.library is None else None,
            assumed=assumed or period_assumed,
            source=entity.place,
            defined=facts.defined,
            blocking=tuple(deeds.blocking) if deeds else (),
            reads=tuple(deeds.reads) if deeds else (),
            writes=tuple(deeds.writes) if deeds else (),
            locks=tuple(deeds.locks) if deeds else (),
            publishes=tuple(deeds.publishes) if deeds else (),
            changes=tuple(deeds.changes) if deeds else (),
        )

    def _alternative(self, entity: EntityState, path: Path) -> str | None:
        """A mark shared by entities on exclusive branches of one statement."""
        for place, index in path:
            if index < 0:
                continue
            branches = self._branches(entity.node)
            if len(branches[place]) > 1:
                return f'{place.file}:{place.line}'
        return None

    def _branches(self, node: Instance) -> dict[Place, set[int]]:
        """By branching statement, the branches on which ``node`` gets entities."""
        known = self._branches_of.get(id(node))
        if known is None:
            known = defaultdict(set)
            for entity in self._world.by_node.get(id(node), ()):
                for place, branch in entity.path:
                    if branch >= 0:
                        known[place].add(branch)
            self._branches_of[id(node)] = known
        return known

    def _executor_value(self, threads: tuple[str, ...], entry: str | None) -> Executor:
        state = self._state()
        if state is None or self._executor is None:
            name = self._taken.take('executor')
            at = self._nodes[0].place
            nested = self._nested_spin()
            return Executor(name=name, threads=threads, kind=nested or Unknown(NO_EXECUTOR, at))
        name = self._taken.take(self._executor.hint or 'executor')
        unresolved = state.unknown or state.unresolved or state.threads_unresolved
        elsewhere = self._spun_elsewhere() if entry is None else None
        if self._spin is None and unresolved is None:
            reason = 'no call that spins this executor is in sight'
            unresolved = self._nested_spin() or Unknown(reason, self._executor.place)
        return Executor(
            name=name,
            threads=threads,
            kind=state.unknown or elsewhere or state.kind,
            threads_source=_threads_source(state),
            in_thread=self._spin.in_thread if self._spin else False,
            spun=self._spin.how if self._spin else None,
            unresolved=unresolved,
            assumed=_assumed_threads(state),
            source=self._spin.place if state.is_global and self._spin else self._executor.place,
        )

    def _nested_spin(self) -> Unknown | None:
        """Why the executor is not followed where only callbacks spin the nodes."""
        for node in self._nodes:
            if node.state.nested is not None:
                how, place = node.state.nested
                return Unknown(f'only {how} inside a callback serves this node', place)
        return None

    def _spun_elsewhere(self) -> Unknown | None:
        """Why somebody who is not in sight may serve the nodes by another executor."""
        spin = self._spin
        if spin is None:
            return None
        if not spin.for_ever and any(is_handed_over(node) for node in self._nodes):
            reason = f'{spin.how} serves this node in passing; who else does is not in sight'
            return Unknown(reason, spin.place)
        if spin.for_ever and any(i >= 0 for _, i in _beyond(spin.path, self._nodes[0].path)):
            reason = f'{spin.how} stands under a condition; who else serves it is not in sight'
            return Unknown(reason, spin.place)
        return None

    def _note_open_ends(self) -> None:
        for node in self._nodes:
            for reason, at in dict.fromkeys(node.state.more):
                self._facts.append(
                    Unresolved(
                        subject=self._node_names[id(node)],
                        fact='entities',
                        reason=reason,
                        source=at,
                    )
                )
        for reason, at in self._world.cut:
            self._facts.append(
                Unresolved(
                    subject=self._node_names[id(self._nodes[0])],
                    fact='entities',
                    reason=reason,
                    source=at,
                )
            )

    def _with_waits(
        self, callbacks: list[Callback], entities: Sequence[EntityState], executor: Executor
    ) -> list[Callback]:
        """What is waited for, by the name it has in this unit."""
        names = {id(e): c.name for e, c in zip(entities, callbacks, strict=True)}
        names |= self._node_names
        for number, setters in self._world.setters.items():
            if len({id(setter) for setter in setters}) == 1 and id(setters[0]) in names:
                names[number] = names[id(setters[0])]
        if self._executor is not None:
            names[id(self._executor)] = executor.name
        return [
            replace(
                callback,
                blocking=tuple(
                    replace(block, on=_waited_name(block.on, names)) for block in callback.blocking
                ),
            )
            for callback in callbacks
        ]

    def _sources(self, entities: Sequence[EntityState]) -> tuple[str, ...]:
        places = [entity.place.file for entity in entities]
        places.extend(node.place.file for node in self._nodes)
        if self._spin is not None:
            places.append(self._spin.place.file)
        return tuple(dict.fromkeys(file for file in places if file))


def is_handed_over(node: Instance) -> bool:
    """Whether the node comes from, or goes to, somebody who is not in sight."""
    made_for_nobody = isinstance(node.cls, Class) and node.place == node.cls.place
    return node.state.ghost is not None or made_for_nobody


def _plain_label(node: Instance) -> str:
    """Name of a node of another unit, as far as it is known."""
    return constant_text(node.state.name) or snake_case(node.class_name)


def _threads_source(state: ExecutorState) -> str | None:
    if state.threads_unresolved is not None:
        return 'unresolved'
    if state.threads is None:
        return 'default_cpu_count'
    return str(state.threads_at) if state.threads_at else None


def _assumed_threads(state: ExecutorState) -> str | None:
    if state.threads is None:
        return (
            f'{ASSUMED_THREADS} threads: rclpy takes the number of CPUs at run time, and '
            f'{ASSUMED_THREADS} where it cannot be had'
        )
    return state.assumed


def _beyond(path: Path, prefix: Path) -> Path:
    """The part of ``path`` that its node does not share."""
    return tuple(step for step in path if step not in prefix)


def _key(value: Value | None) -> tuple[str | Unknown | None, str | None]:
    if value is None:
        return None, None
    text = constant_text(value)
    if text is not None:
        return text, None
    if isinstance(value, Mystery):
        default = constant_text(value.default)
        if default is not None:
            return default, f'name is the default of parameter {value.text!r}'
        label = f'{value.text}: ' if value.text else ''
        return Unknown(f'{label}{value.unknown.reason}', value.unknown.at), None
    return Unknown('name that could not be followed'), None


def _period(value: Value | None) -> tuple[float | Unknown | None, str | None]:
    if value is None:
        return None, None
    number = _number(value)
    if number is not None:
        return number, None
    if isinstance(value, Mystery):
        default = _number(value.default)
        if default is not None:
            return default, f'period is the default of parameter {value.text!r}'
        label = f'{value.text}: ' if value.text else ''
        return Unknown(f'{label}{value.unknown.reason}', value.unknown.at), None
    return Unknown('period that could not be followed'), None


def _number(value: Value | None) -> float | None:
    if isinstance(value, Const) and isinstance(value.value, (int, float)):
        return float(value.value)
    return None


def _waited_name(on: object, names: dict[int, str]) -> str | Unknown | None:
    if isinstance(on, SettableRef):
        return names.get(on.number) or str(on)
    if isinstance(on, EntityRef):
        return names.get(on.number) or Unknown('an entity of another executor')
    return on if isinstance(on, (str, Unknown)) else None


def _unit_label(nodes: Sequence[str]) -> str:
    """Name a unit by its nodes; a file is often called ``node.py`` and tells nothing."""
    if len(nodes) > 2:
        return f'{nodes[0]}_and_{len(nodes) - 1}_more'
    return '_and_'.join(nodes) or 'unit'
