"""One unit's callbacks, groups and executor as values of the specification."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ros2cc_extract.extract.names import Names, Wanted, unique_names
from ros2cc_extract.extract.static.libraries.rclpy.machine.assumptions import assumption
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.values.exclusive_paths import Branches, beyond, shared
from ros2cc_extract.extract.static.python.values.values import (
    Class,
    Const,
    Instance,
    Mystery,
    Value,
)
from ros2cc_extract.extract.static.units.activities import (
    activities_of,
    activity,
    facts_of,
    own_spins,
)
from ros2cc_extract.extract.static.units.callback_names import (
    FunctionFacts,
    constant_text,
    describe,
    snake_case,
)
from ros2cc_extract.extract.static.units.entity_aliases import same_on_a_ghost
from ros2cc_extract.extract.static.units.executor import Unit, executor_of
from ros2cc_extract.extract.static.units.handed_functions import handed_to_others, that_answer
from ros2cc_extract.extract.static.units.set_up_waits import named_waits
from ros2cc_extract.extract.static.units.torn_messages import pieces_of
from ros2cc_extract.extract.static.units.unused_groups import unused_groups
from ros2cc_extract.extract.static.units.waits import UnitWaits
from ros2cc_extract.extract.static.units.working_loops import without_loops_for_good
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.identifiers import mend
from ros2cc_extract.spec.model import (
    Activity,
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    Origin,
    Spec,
    Unresolved,
    When,
)

_ORDER = {
    EntityKind.TIMER: 0,
    EntityKind.SUBSCRIPTION: 1,
    EntityKind.GUARD_CONDITION: 2,
    EntityKind.SERVICE: 3,
    EntityKind.CLIENT: 4,
    EntityKind.ACTION_SERVER: 5,
    EntityKind.ACTION_CLIENT: 6,
    EntityKind.WAITABLE: 7,
    EntityKind.PARAMETER_SERVICE: 8,
    EntityKind.LIFECYCLE_SERVICE: 9,
    EntityKind.QOS_EVENT: 10,
    EntityKind.ACTION_EXECUTE: 11,
    EntityKind.DONE_CALLBACK: 12,
    EntityKind.TASK: 13,
}
_GROUPLESS = (EntityKind.ACTION_EXECUTE, EntityKind.DONE_CALLBACK, EntityKind.TASK)


class UnitBuilder:
    """Builds the specification of one executor with its nodes."""

    def __init__(self, world: RosWorld, unit: Unit) -> None:
        self._world = world
        self._unit = unit
        self._nodes = unit.nodes
        self._taken = Names()
        self._facts: list[Unresolved] = []
        self._node_names: dict[int, str] = {}
        self._group_names: dict[int, str] = {}
        self._same: dict[int, EntityState] = {}
        made = [entity for node in self._nodes for entity in world.by_node.get(id(node), ())]
        self._branches = Branches(entity.path for entity in made)
        self._shared_path = shared([node.path for node in self._nodes])

    def build(self, entry: str | None) -> Spec:
        """The specification."""
        names = self._name_nodes()
        name = self._taken.take(names[0] if len(names) == 1 else _unit_label(names))
        threads = tuple(map(self._taken.take, self._unit.thread_names))
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
        executor_name = self._taken.take(self._unit.executor_label)
        executor = executor_of(self._unit, executor_name, threads, entry, self._world)
        with_waits, activities, set_up = self._with_waits(callbacks, entities, executor)
        handed = self._handed(executor)
        answering = that_answer(handed, activities, self._world)
        return Spec(
            name=name,
            callbacks=with_waits,
            activities=(*activities, *answering),
            handed=tuple(
                replace(each, name=self._taken.take(each.name)) if runs_beside else each
                for each, runs_beside in handed
            ),
            set_up=set_up,
            groups=tuple(groups),
            executor=executor,
            origin=Origin.STATIC,
            nodes=tuple(names),
            sources=self._sources(entities),
            entry=entry,
            unresolved=tuple(self._facts),
        )

    def _handed(self, executor: Executor) -> tuple[tuple[Activity, bool], ...]:
        """Functions that code which is not scanned has, where something serves the nodes."""
        if self._unit.executor is None:
            return ()
        is_only = self._unit.is_only
        names, taken = self._node_names, self._taken
        return handed_to_others(self._world, self._nodes, names, taken, executor, is_only=is_only)

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
            reason = 'no call of Node.__init__ with a name is known'
        self._facts.append(
            Unresolved(subject=mend(label), fact='node_name', reason=reason, source=at)
        )
        return label

    def _entities(self) -> list[EntityState]:
        """Node by node, timers first, group-less work last; creation order within a kind."""
        position = {id(node): index for index, node in enumerate(self._nodes)}
        mine = [entity for node in self._nodes for entity in self._world.by_node.get(id(node), ())]
        mine += [entity for entity in self._world.builtins if id(entity.node) in position]
        return sorted(
            self._each_once(mine),
            key=lambda e: (
                e.kind in _GROUPLESS,
                position[id(e.node)],
                _ORDER[e.kind],
                e.number,
            ),
        )

    def _each_once(self, entities: Sequence[EntityState]) -> list[EntityState]:
        """What objects in the same position make on an unknown node is one entity."""
        kept: dict[object, EntityState] = {}
        for entity in entities:
            key = same_on_a_ghost(entity)
            first = kept.setdefault(key or id(entity), entity)
            if first is not entity:
                self._same[id(entity)] = first
                first.count = Unknown('made once by each object of its kind', entity.place)
        return list(kept.values())

    def _facts_of(self, entity: EntityState) -> FunctionFacts:
        if entity.kind in (EntityKind.CLIENT, EntityKind.ACTION_CLIENT, EntityKind.ACTION_SERVER):
            return self._server_or_client_facts(entity)
        if entity.library is not None and entity.callback is None:
            label = entity.label or 'rate_timer'
            return FunctionFacts(label)
        facts = describe(entity.callback, entity.place)
        return replace(facts, label=entity.label) if entity.builtin and entity.label else facts

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
        """The groups in use, in order of first use by creation; then unused ones."""
        unwritten = {id(entity) for entity in self._world.builtins}
        pairs = sorted(
            zip(entities, labels, strict=True),
            key=lambda p: (p[0].kind in _GROUPLESS, id(p[0]) in unwritten, p[0].number),
        )
        groups: list[CallbackGroup] = []
        for entity, label in pairs:
            if id(entity.group) in self._group_names:
                continue
            name = self._taken.take(self._group_label(entity, label))
            self._group_names[id(entity.group)] = name
            groups.append(self._group(entity.group, name))
        for group in unused_groups(self._nodes, self._world):
            groups.append(self._group(group, self._taken.take(group.hint or 'unused_group')))
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
        path = beyond(entity.path, self._shared_path)
        alternative, branch = self._branches.mark_of(path)
        effects = entity.effects
        key, assumed = _key_of(entity)
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
            alternative=alternative,
            branch=branch,
            coroutine=facts.coroutine,
            one_shot=entity.one_shot and not entity.restarted,
            cancelled=entity.cancelled or entity.dormant is not None,
            takes_info=entity.takes_info,
            destroyed=entity.destroyed or bool(entity.part_of and entity.part_of.destroyed),
            groupless=entity.kind in _GROUPLESS,
            library=entity.library,
            builtin=entity.builtin,
            unresolved=facts.unresolved if entity.library is None else None,
            assumed=assumed or period_assumed or entity.assumed,
            source=entity.place,
            defined=facts.defined,
            reads=tuple(effects.reads) if effects else (),
            writes=tuple(effects.writes) if effects else (),
            locks=tuple(effects.locks) if effects else (),
            changes=tuple(effects.changes) if effects else (),
            pieces=pieces_of(entity, self._world),
        )

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
        for cut in self._world.cut:
            nodes = self._world.nodes
            concerned = [node for node in nodes if not cut.classes.isdisjoint(node.mro)]
            mine = [node for node in self._nodes if node in concerned or not concerned][:1]
            self._facts.extend(
                Unresolved(
                    subject=self._node_names[id(node)],
                    fact='entities',
                    reason=cut.reason,
                    source=cut.place,
                )
                for node in mine
            )

    def _with_waits(
        self, callbacks: list[Callback], entities: Sequence[EntityState], executor: Executor
    ) -> tuple[tuple[Callback, ...], tuple[Activity, ...], tuple[Blocking, ...]]:
        """What is waited for, by its name in this unit; the activities beside; the set-up."""
        names = {id(e): c.name for e, c in zip(entities, callbacks, strict=True)}
        names |= {number: names[id(first)] for number, first in self._same.items()}
        names |= self._node_names
        if self._unit.executor is not None:
            names[id(self._unit.executor)] = executor.name
        states = activities_of(self._world, self._nodes, entities, is_only=self._unit.is_only)
        names |= {id(state): self._taken.take(facts_of(state).label) for state in states}
        waits = UnitWaits(self._world, names, (*entities, *states))
        doers = {names[id(doer)]: doer for doer in (*entities, *states)}
        with_waits = tuple(
            replace(callback, blocking=waits.of(entity), publishes=waits.messages_of(entity))
            for callback, entity in zip(callbacks, entities, strict=True)
        )
        activities = [
            activity(
                state,
                names,
                waits,
                pieces_of(state, self._world),
                own_spins(state, self._world, self._nodes),
            )
            for state in states
        ]
        set_up = named_waits(self._unit.set_up, self._world, waits, doers)
        threads, with_waits = without_loops_for_good(activities, with_waits)
        return with_waits, threads, set_up

    def _sources(self, entities: Sequence[EntityState]) -> tuple[str, ...]:
        places = [entity.place.file for entity in entities]
        places.extend(node.place.file for node in self._nodes)
        if self._unit.spin is not None:
            places.append(self._unit.spin.place.file)
        return tuple(dict.fromkeys(file for file in places if file))


def _plain_label(node: Instance) -> str:
    """Name of a node of another unit, as far as it is known."""
    return constant_text(node.state.name) or snake_case(node.class_name)


def _key_of(entity: EntityState) -> tuple[str | Unknown | None, str | None]:
    """Its name, and the rule that assumed it; a client's unknown name is reported once."""
    key, assumed = _key(entity.key)
    is_reported = entity.kind is EntityKind.DONE_CALLBACK and isinstance(key, Unknown)
    return (None, None) if is_reported else (key, assumed)


def _key(value: Value | None) -> tuple[str | Unknown | None, str | None]:
    if value is None:
        return None, None
    text = constant_text(value)
    if text is not None:
        return text, None
    if isinstance(value, Mystery):
        default = constant_text(value.default)
        if default is not None:
            return default, assumption('name', value)
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
            return default, assumption('period', value)
        label = f'{value.text}: ' if value.text else ''
        return Unknown(f'{label}{value.unknown.reason}', value.unknown.at), None
    return Unknown('period that could not be followed'), None


def _number(value: Value | None) -> float | None:
    if isinstance(value, Const) and isinstance(value.value, (int, float)):
        return float(value.value)
    return None


def _unit_label(nodes: Sequence[str]) -> str:
    """Name a unit by its nodes; a file is often called ``node.py`` and says nothing."""
    if len(nodes) > 2:
        return f'{nodes[0]}_and_{len(nodes) - 1}_more'
    return '_and_'.join(nodes) or 'unit'
