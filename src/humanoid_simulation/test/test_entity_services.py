# SPDX-License-Identifier: Apache-2.0
"""The services of `simulation_interfaces`, called as its clients do."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
import math
from typing import Any

from geometry_msgs.msg import Point, Pose, PoseStamped, Vector3
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_simulation.testing.watched_simulator import WatchedSimulator
import pytest
from rclpy.action import ActionClient
from simulation_interfaces.action import SimulateSteps
from simulation_interfaces.msg import (
    Bounds,
    EntityCategory,
    EntityFilters,
    EntityInfo,
    Resource,
    Result,
    SimulationState,
    SimulatorFeatures,
    TagsFilter,
)
from simulation_interfaces.srv import (
    DeleteEntity,
    GetAvailableWorlds,
    GetCurrentWorld,
    GetEntities,
    GetEntitiesStates,
    GetEntityBounds,
    GetEntityInfo,
    GetEntityState,
    GetNamedPoseBounds,
    GetNamedPoses,
    GetSimulationState,
    GetSimulatorFeatures,
    GetSpawnables,
    LoadWorld,
    ResetSimulation,
    SetEntityInfo,
    SetEntityState,
    SetSimulationState,
    SpawnEntity,
    UnloadWorld,
)
from tf2_msgs.msg import TFMessage

OK = Result.RESULT_OK


@pytest.fixture(name='home', scope='module')
def _home() -> Iterator[WatchedSimulator]:
    """Give a paused simulator of the apartment, which tests leave as it was."""
    with ros_sandbox() as ros:
        yield WatchedSimulator(ros, scene='apartment', start_paused=True)


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def call(simulator: WatchedSimulator, kind: type, **request: Any) -> Any:
    """Call the service of a type, which gives its name."""
    words = ''.join(f'_{char.lower()}' if char.isupper() else char for char in kind.__name__)
    return simulator.ask(kind, f'simulator/{words[1:]}', **request)


def found(simulator: WatchedSimulator, **filters: Any) -> list[str]:
    """Return the entities that a filter lets through."""
    answer = call(simulator, GetEntities, filters=EntityFilters(**filters))
    assert answer.result.result == OK, answer.result.error_message
    return list(answer.entities)


def test_entities_are_found(home: WatchedSimulator) -> None:
    """By a whole name, category, tags and place; all that is said applies together."""
    everything = found(home)
    assert {'robot', 'red_mug', 'kitchen_table'} <= set(everything)
    assert found(home, filter='red_.*') == [name for name in everything if name[:4] == 'red_']
    assert found(home, filter='red') == []
    assert found(home, tags=TagsFilter(tags=['mug', 'red'])) > found(
        home, tags=TagsFilter(tags=['mug', 'red'], filter_mode=TagsFilter.FILTER_MODE_ALL)
    )
    robots = [EntityCategory(category=EntityCategory.CATEGORY_ROBOT)]
    assert found(home, categories=robots) == ['robot']
    humans = [EntityCategory(category=EntityCategory.CATEGORY_HUMAN)]
    assert len(found(home, categories=humans)) == 2
    mug = call(home, GetEntityState, entity='red_mug').state.pose.position
    here = Vector3(x=mug.x, y=mug.y, z=mug.z)
    sphere = Bounds(type=Bounds.TYPE_SPHERE, points=[here, Vector3(x=0.02)])
    assert found(home, bounds=sphere) == ['red_mug']
    low, high = Vector3(x=-0.5, y=-0.5), Vector3(x=0.5, y=0.5, z=2.0)
    box = Bounds(type=Bounds.TYPE_BOX, points=[low, high])
    assert 'robot' in found(home, bounds=box) and 'red_mug' not in found(home, bounds=box)


@pytest.mark.parametrize(
    ('filters', 'sentence'),
    [
        ({'filter': '['}, 'is not a valid regular expression'),
        ({'bounds': Bounds(type=Bounds.TYPE_BOX)}, 'The bounds are not valid'),
        ({'bounds': Bounds(type=Bounds.TYPE_CONVEX_HULL)}, 'Give a box or a sphere'),
        (
            {'bounds': Bounds(type=1, points=[Vector3(x=math.nan), Vector3(x=1.0)])},
            'not finite',
        ),
    ],
)
def test_wrong_filters(home: WatchedSimulator, filters: Any, sentence: str) -> None:
    """They are refused with a sentence."""
    result = call(home, GetEntities, filters=EntityFilters(**filters)).result
    assert result.result != OK and sentence in result.error_message


def test_what_is_told_of_entities(home: WatchedSimulator) -> None:
    """State, description and bounds fit together, one by one and all at once."""
    states = call(home, GetEntitiesStates, filters=EntityFilters(filter='.*mug'))
    assert len(states.entities) == len(states.states) >= 4
    state = call(home, GetEntityState, entity='red_mug').state
    assert state.header.frame_id == 'world'
    at = list(states.entities).index('red_mug')
    assert states.states[at].pose == state.pose
    info = call(home, GetEntityInfo, entity='red_mug').info
    assert info.description == 'a red mug, in the kitchen'
    assert info.category.category == EntityCategory.CATEGORY_DYNAMIC_OBJECT
    assert list(info.tags) == ['red', 'mug', 'kitchen']
    low, high = call(home, GetEntityBounds, entity='red_mug').bounds.points
    assert high.z - low.z == pytest.approx(0.1, abs=0.01)
    table = call(home, GetEntityInfo, entity='kitchen_table').info
    assert table.category.category == EntityCategory.CATEGORY_STATIC_OBJECT
    missing = call(home, GetEntityState, entity='red_mog')
    assert missing.result.result == Result.RESULT_NOT_FOUND
    assert "Did you mean 'red_mug'" in missing.result.error_message


def test_descriptions_can_be_changed(home: WatchedSimulator) -> None:
    """What is said of an entity is told from then on; a category must be one."""
    info = EntityInfo(description='the one with the crack', tags=['broken'])
    info.category.category = EntityCategory.CATEGORY_OBJECT
    assert call(home, SetEntityInfo, entity='blue_mug', info=info).result.result == OK
    assert call(home, GetEntityInfo, entity='blue_mug').info == info
    assert found(home, tags=TagsFilter(tags=['broken'])) == ['blue_mug']
    info.category.category = 77
    refused = call(home, SetEntityInfo, entity='blue_mug', info=info).result
    assert 'no category 77' in refused.error_message


def test_places_spawnables_and_features(home: WatchedSimulator) -> None:
    """What the scene names, what can be made, and what can be done."""
    poses = {pose.name: pose for pose in call(home, GetNamedPoses).poses}
    assert poses['kitchen_table'].tags == ['kitchen', 'kitchen_table']
    tagged = call(home, GetNamedPoses, tags=TagsFilter(tags=['bedroom'])).poses
    assert tagged and all('bedroom' in pose.tags for pose in tagged)
    refused = call(home, GetNamedPoseBounds, name='kitchen_table').result
    assert refused.result == Result.RESULT_FEATURE_UNSUPPORTED
    refused = call(home, GetNamedPoseBounds, name='kitchen_tabel').result
    assert refused.result == Result.RESULT_NOT_FOUND
    uris = [each.entity_resource.uri for each in call(home, GetSpawnables).spawnables]
    assert {'mug', 'book'} <= set(uris)
    features = call(home, GetSimulatorFeatures).features
    assert SimulatorFeatures.SPAWNING in features.features
    assert SimulatorFeatures.SIMULATION_RESET_TIME not in features.features
    assert 'urdf' in features.spawn_formats


def spawn(simulator: WatchedSimulator, name: str, uri: str = 'red mug', **request: Any) -> Any:
    """Make a thing."""
    resource = Resource(uri=uri)
    return call(simulator, SpawnEntity, name=name, entity_resource=resource, **request)


def test_things_come_and_go(ros: RosSandbox) -> None:
    """What is made is there, in its place, and seen; a reset takes it away, and brings back."""
    home = WatchedSimulator(ros, scene='apartment', start_paused=True)
    at = PoseStamped(pose=Pose(position=Point(z=0.5)))
    at.header.frame_id = 'red_mug'
    assert spawn(home, 'new', initial_pose=at).result.result == OK
    mug = call(home, GetEntityState, entity='red_mug').state.pose.position
    new = call(home, GetEntityState, entity='new').state.pose.position
    assert (new.x, new.y) == pytest.approx((mug.x, mug.y))
    assert new.z == pytest.approx(mug.z + 0.5)
    text = Resource(resource_string='{name: other, shape: box, size: [0.1, 0.1, 0.1], mass: 1}')
    answer = call(home, SpawnEntity, name='crate', entity_resource=text)
    assert (answer.result.result, answer.entity_name) == (OK, 'crate') and 'crate' in found(home)
    assert spawn(home, 'new', allow_renaming=True).entity_name == 'new_2'
    assert spawn(home, '', allow_renaming=True).entity_name == 'red_mug_2'
    assert call(home, DeleteEntity, entity='red_mug').result.result == OK
    assert call(home, DeleteEntity, entity='kitchen_table').result.result == OK
    assert 'red_mug' not in found(home)
    poses = {pose.name: pose for pose in call(home, GetNamedPoses).poses}
    assert poses['kitchen_table'].tags == ['kitchen']
    spawned = ResetSimulation.Request.SCOPE_SPAWNED
    assert call(home, ResetSimulation, scope=spawned).result.result == OK
    names = found(home)
    assert {'red_mug', 'kitchen_table'} <= set(names) and 'new' not in names
    assert not home.step(20)


@pytest.mark.parametrize(
    ('request_', 'number', 'sentence'),
    [
        ({'name': 'red_mug'}, SpawnEntity.Response.NAME_NOT_UNIQUE, 'allow_renaming'),
        ({'name': 'robot'}, SpawnEntity.Response.NAME_NOT_UNIQUE, 'allow_renaming'),
        ({'name': ''}, SpawnEntity.Response.NAME_INVALID, 'Give a name'),
        ({'name': 'a/b'}, SpawnEntity.Response.NAME_INVALID, 'Give a name'),
        ({'name': 'x', 'uri': 'x.sdf'}, SpawnEntity.Response.UNSUPPORTED_FORMAT, '.urdf'),
        ({'name': 'x', 'uri': ''}, SpawnEntity.Response.NO_RESOURCE, 'both are empty'),
        (
            {'name': 'x', 'entity_namespace': 'a b'},
            SpawnEntity.Response.NAMESPACE_INVALID,
            'not a valid namespace',
        ),
        *(
            (
                {'name': 'x', 'initial_pose': PoseStamped(pose=Pose(position=Point(x=x_m)))},
                SpawnEntity.Response.INVALID_POSE,
                sentence,
            )
            for x_m, sentence in ((math.nan, 'finite'), (1e9, 'out of range'))
        ),
    ],
)
def test_what_is_not_made(
    home: WatchedSimulator, request_: dict[str, Any], number: int, sentence: str
) -> None:
    """The number is that of the standard; nothing has come."""
    before = found(home)
    result = spawn(home, **request_).result
    assert (result.result, sentence in result.error_message) == (number, True), result
    assert found(home) == before


def test_what_stays_where_it_is(home: WatchedSimulator) -> None:
    """Robots are not deleted; what is fixed, and what is nowhere, is not put anywhere."""
    refused = call(home, DeleteEntity, entity='robot').result
    assert 'cannot be deleted' in refused.error_message
    refused = call(home, SetEntityState, entity='kitchen_table').result
    assert refused.result == SetEntityState.Response.INVALID_POSE
    request = SetEntityState.Request(entity='red_mug')
    request.state.header.frame_id = 'nowhere'
    refused = call(home, SetEntityState, entity='red_mug', state=request.state).result
    assert refused.result == SetEntityState.Response.INVALID_POSE


def test_states_of_the_simulation(ros: RosSandbox) -> None:
    """Playing, paused and stopped; what leads nowhere is refused."""
    simulator = WatchedSimulator(ros)

    def state() -> int:
        return int(call(simulator, GetSimulationState).state.state)

    def set_state(wanted: int) -> int:
        message = SimulationState(state=wanted)
        return int(call(simulator, SetSimulationState, state=message).result.result)

    assert state() == SimulationState.STATE_PLAYING
    again = SetSimulationState.Response.ALREADY_IN_TARGET_STATE
    assert set_state(SimulationState.STATE_PLAYING) == again
    assert set_state(SimulationState.STATE_PAUSED) == OK
    assert not simulator.put('', 1.0, 0.0, 0.7)
    assert set_state(SimulationState.STATE_STOPPED) == OK
    assert state() == SimulationState.STATE_STOPPED
    place = call(simulator, GetEntityState, entity='robot').state.pose.position
    assert abs(place.x) < 0.05
    for wrong in (SimulationState.STATE_NO_WORLD, 99):
        assert set_state(wrong) == SetSimulationState.Response.INCORRECT_TRANSITION
    assert not simulator.step(5)
    assert state() == SimulationState.STATE_PAUSED
    assert set_state(SimulationState.STATE_PLAYING) == OK
    simulator.run(0.1)
    refused = call(simulator, ResetSimulation, scope=ResetSimulation.Request.SCOPE_TIME).result
    assert refused.result == Result.RESULT_FEATURE_UNSUPPORTED
    for scope in (0, ResetSimulation.Request.SCOPE_ALL, 2, 4, 6):
        assert call(simulator, ResetSimulation, scope=scope).result.result == OK


def test_the_simulator_quits(ros: RosSandbox) -> None:
    """It answers, and then its context is shut down, which ends the node."""
    simulator = WatchedSimulator(ros)
    message = SimulationState(state=SimulationState.STATE_QUITTING)
    assert call(simulator, SetSimulationState, state=message).result.result == OK
    context = simulator.simulator.context
    with suppress(Exception):  # of the executor, whose context is gone
        simulator.wait('the end', lambda: not context.ok())
    assert not context.ok()


def test_worlds_are_loaded(ros: RosSandbox) -> None:
    """Another scene with the robot where it begins, stopped; mistakes change nothing."""
    simulator = WatchedSimulator(ros)
    simulator.listen(TFMessage, 'tf')
    assert call(simulator, GetCurrentWorld).world.name == 'flat'
    names = {world.name for world in call(simulator, GetAvailableWorlds).worlds}
    assert {'flat', 'apartment'} <= names
    refused = call(simulator, GetAvailableWorlds, additional_sources=['/nowhere']).result
    assert 'cannot be read' in refused.error_message
    kept = call(
        simulator, GetAvailableWorlds, additional_sources=['/nowhere'], continue_on_error=True
    )
    assert kept.result.result == OK and kept.worlds
    bad = call(simulator, LoadWorld, resource_string='things: [{name: robot}]').result
    assert bad.result == LoadWorld.Response.RESOURCE_PARSE_ERROR
    taken = 'things: [{name: robot, shape: box, size: [1, 1, 1], position: [5, 0, 1]}]'
    bad = call(simulator, LoadWorld, resource_string=taken).result
    assert bad.result != OK and "an object named 'robot'" in bad.error_message
    assert call(simulator, LoadWorld, uri='x.world').result.result == 101
    assert call(simulator, GetCurrentWorld).world.name == 'flat'
    simulator.run(0.2)
    answer = call(simulator, LoadWorld, uri='room')
    assert (answer.result.result, answer.world.name) == (OK, 'room')
    assert call(simulator, GetCurrentWorld).world.name == 'room'
    state = call(simulator, GetSimulationState).state.state
    assert state == SimulationState.STATE_STOPPED
    assert 'red_box' in found(simulator)
    assert not simulator.pause(False)
    simulator.run(1.0)
    place = call(simulator, GetEntityState, entity='').state.pose.position
    assert abs(place.x) < 0.1 and place.z > 0.6
    refused = call(simulator, UnloadWorld).result
    assert refused.result == Result.RESULT_FEATURE_UNSUPPORTED
    assert not simulator.reset()
    assert 'red_box' in found(simulator)


def test_steps_as_an_action(ros: RosSandbox) -> None:
    """It says how far it is, can be cancelled, and is refused while time passes."""
    simulator = WatchedSimulator(ros, start_paused=True)
    client = ActionClient(simulator.node, SimulateSteps, 'simulator/simulate_steps')
    simulator.wait('the action', client.server_is_ready)
    heard: list[tuple[int, int]] = []

    def send(steps: int) -> Any:
        goal = SimulateSteps.Goal(steps=steps)
        future = client.send_goal_async(
            goal,
            feedback_callback=lambda message: heard.append(
                (message.feedback.completed_steps, message.feedback.remaining_steps)
            ),
        )
        simulator.wait('the goal', future.done)
        return future.result()

    def end(handle: Any) -> Result:
        future = handle.get_result_async()
        simulator.wait('the end', future.done)
        return future.result().result.result

    assert end(send(200)).result == OK
    assert simulator.simulator._backend.time_s == pytest.approx(0.4)
    assert heard[-1] == (200, 0)
    assert [sum(pair) for pair in heard] == [200] * len(heard)
    long = send(90_000)
    simulator.wait('some steps', lambda: heard[-1][1] > 0)
    cancel = long.cancel_goal_async()
    simulator.wait('the cancellation', cancel.done)
    assert 'cancelled' in end(long).error_message
    assert not simulator.pause(False)
    assert end(send(5)).result == Result.RESULT_INCORRECT_STATE
    client.destroy()
