# SPDX-License-Identifier: Apache-2.0
"""Services of `simulation_interfaces` for time and worlds; also pushes and `stand_up`."""

from __future__ import annotations

from functools import partial
from typing import Any

from humanoid_common.executing import create_async_service, RESULT_TIMEOUT_S
from humanoid_control.hosting.conversions import seconds
from humanoid_control.hosting.topics.filling import topic
from humanoid_interfaces.srv import ApplyWrench
from humanoid_simulation.errors import ResourceError, SimulationError
from humanoid_simulation.scene.resources import (
    installed_worlds,
    LoadableWorld,
    THING_FORMATS,
    world_at,
    world_of,
    worlds_in,
)
from humanoid_simulation.service_messages import (
    answering,
    answering_later,
    failure,
    refusing_resource,
    RequestError,
    vector,
)
from humanoid_simulation.simulated_world import SimulatedWorld, State
from humanoid_simulation.simulator_parameters import SimulatorParameters
from rclpy.action import ActionServer, CancelResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from simulation_interfaces.action import SimulateSteps
from simulation_interfaces.msg import (
    Resource,
    Result,
    SimulationState,
    SimulatorFeatures,
    WorldResource,
)
from simulation_interfaces.srv import (
    GetAvailableWorlds,
    GetCurrentWorld,
    GetSimulationState,
    GetSimulatorFeatures,
    LoadWorld,
    ResetSimulation,
    SetSimulationState,
    StepSimulation,
    UnloadWorld,
)
from std_srvs.srv import Trigger

FEATURES = tuple(
    getattr(SimulatorFeatures, name)
    for name in (
        'SPAWNING DELETING NAMED_POSES ENTITY_TAGS ENTITY_BOUNDS ENTITY_BOUNDS_BOX '
        'ENTITY_CATEGORIES SPAWNING_RESOURCE_STRING ENTITY_STATE_GETTING ENTITY_STATE_SETTING '
        'ENTITY_INFO_GETTING ENTITY_INFO_SETTING SPAWNABLES SIMULATION_RESET '
        'SIMULATION_RESET_STATE SIMULATION_RESET_SPAWNED SIMULATION_STATE_GETTING '
        'SIMULATION_STATE_SETTING SIMULATION_STATE_PAUSE STEP_SIMULATION_SINGLE '
        'STEP_SIMULATION_MULTIPLE STEP_SIMULATION_ACTION WORLD_LOADING WORLD_RESOURCE_STRING '
        'WORLD_INFO_GETTING AVAILABLE_WORLDS'
    ).split()
)
_ABOUT = (
    'MuJoCo. Time never goes back. Physics steps are rounded up to whole control periods. Objects '
    'can be spawned from a class, also with a colour (red mug), or from a rigid URDF of boxes, '
    'cylinders and spheres.'
)
_FEEDBACK_PERIODS = 10
"""Control periods between two feedback messages of the action SimulateSteps."""
_QUIT_S = 0.2
"""Delay from the response to the shutdown of the simulator."""


class SimulationServices:
    """
    Services of `simulation_interfaces` for state, steps, reset and worlds; pushes and `stand_up`.

    Parameters
    ----------
    node
        The node that provides them, below its own name; `stand_up` in that of each robot.
    world
        The world that they act on.
    parameters : SimulatorParameters
        The parameters of the simulator, of which `scene` and `reset_keyframe` are used.

    Raises
    ------
    ResourceError
        There is no such scene, or its file cannot be read.

    """

    def __init__(self, node: Node, world: SimulatedWorld, parameters: SimulatorParameters) -> None:
        self._node, self._world = node, world
        self._loaded = world_at(parameters.scene)
        self.change(parameters)
        for kind, service, do in (
            (GetSimulationState, 'get_simulation_state', self._tell_state),
            (SetSimulationState, 'set_simulation_state', self._set_state),
            (ResetSimulation, 'reset_simulation', self._reset),
            (GetCurrentWorld, 'get_current_world', self._tell_world),
            (GetAvailableWorlds, 'get_available_worlds', self._tell_worlds),
            (LoadWorld, 'load_world', self._load),
            (UnloadWorld, 'unload_world', self._unload),
        ):
            node.create_service(kind, f'~/{service}', answering(do))
        node.create_service(GetSimulatorFeatures, '~/get_simulator_features', _tell_features)
        # In their own callback groups: all other callbacks run while they wait for their steps.
        create_async_service(
            node,
            StepSimulation,
            '~/step_simulation',
            answering_later(self._step),
            callback_group=MutuallyExclusiveCallbackGroup(),
        )
        self._steps = ActionServer(
            node,
            SimulateSteps,
            '~/simulate_steps',
            self._simulate_steps,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            result_timeout=RESULT_TIMEOUT_S,
            callback_group=MutuallyExclusiveCallbackGroup(),
        )
        node.create_service(ApplyWrench, '~/apply_wrench', partial(_answer, self._push))
        for robot in world.backend.robots:
            stand_up = partial(_answer, partial(self._stand_up, robot))
            node.create_service(Trigger, topic(robot, 'stand_up'), stand_up)

    def change(self, parameters: SimulatorParameters) -> None:
        """
        Apply changed parameters: the posture in which robots start after the next reset.

        Parameters
        ----------
        parameters : SimulatorParameters
            The parameters of the simulator, of which `reset_keyframe` is used.

        """
        self._keyframe = parameters.reset_keyframe

    def _tell_state(self, _: Any, response: GetSimulationState.Response) -> None:
        """Report the state of the simulation."""
        response.state.state = int(self._world.state)

    def _set_state(self, request: SetSimulationState.Request, _: Any) -> None:
        """Play, pause, stop or quit the simulation."""
        wanted, world = request.state.state, self._world
        if wanted == world.state and not world.is_stepping:
            raise RequestError(
                SetSimulationState.Response.ALREADY_IN_TARGET_STATE,
                f'The simulation is already {world.state.name.lower()}.',
            )
        if wanted == SimulationState.STATE_PLAYING and world.has_failed:
            raise RequestError(
                SetSimulationState.Response.STATE_TRANSITION_ERROR,
                'The physics has failed; reset the simulation first.',
            )
        if wanted == SimulationState.STATE_STOPPED:
            world.stop(self._keyframe)
        elif wanted in (SimulationState.STATE_PLAYING, SimulationState.STATE_PAUSED):
            world.pause(wanted == SimulationState.STATE_PAUSED)
        elif wanted == SimulationState.STATE_QUITTING:
            self._quit()
        else:
            raise RequestError(
                SetSimulationState.Response.INCORRECT_TRANSITION,
                f'The state {wanted} cannot be set. Give {State.STOPPED:d} (stopped), '
                f'{State.PLAYING:d} (playing), {State.PAUSED:d} (paused) or '
                f'{SimulationState.STATE_QUITTING} (quitting).',
            )

    def _quit(self) -> None:
        """Shut down the node once the response has been sent."""
        self._node.get_logger().info(
            'The simulator is shutting down, as requested through set_simulation_state'
        )
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._node.create_timer(_QUIT_S, self._node.context.try_shutdown, clock=steady)

    def _reset(self, request: ResetSimulation.Request, _: Any) -> None:
        """Reset the state, the spawned objects, or both; time continues."""
        scope = request.scope or ResetSimulation.Request.SCOPE_ALL
        parts = scope & (
            ResetSimulation.Request.SCOPE_STATE | ResetSimulation.Request.SCOPE_SPAWNED
        )
        if scope != ResetSimulation.Request.SCOPE_ALL and scope != parts:
            raise RequestError(
                Result.RESULT_FEATURE_UNSUPPORTED,
                'Time cannot be reset: it would jump back for all nodes that use it. Give scope '
                f'{ResetSimulation.Request.SCOPE_STATE} (state), '
                f'{ResetSimulation.Request.SCOPE_SPAWNED} (spawned), their sum, or 0 for both.',
            )
        self._world.reset(
            bool(parts & ResetSimulation.Request.SCOPE_STATE),
            bool(parts & ResetSimulation.Request.SCOPE_SPAWNED),
            self._keyframe,
        )

    async def _step(self, request: StepSimulation.Request, _: Any) -> None:
        """Advance a paused simulation by whole control periods."""
        await self._world.step(self._periods(request.steps))

    async def _simulate_steps(self, goal: ServerGoalHandle) -> SimulateSteps.Result:
        """Advance a paused simulation, and publish feedback."""
        result, steps = SimulateSteps.Result(), goal.request.steps
        try:
            periods = self._periods(steps)
            for done in range(0, periods, _FEEDBACK_PERIODS):
                if goal.is_cancel_requested:
                    goal.canceled()
                    result.result.result = Result.RESULT_OPERATION_FAILED
                    result.result.error_message = 'The steps were cancelled.'
                    return result
                await self._world.step(min(_FEEDBACK_PERIODS, periods - done))
                share = min(1.0, (done + _FEEDBACK_PERIODS) / periods)
                completed = int(share * steps)
                goal.publish_feedback(
                    SimulateSteps.Feedback(
                        completed_steps=completed, remaining_steps=steps - completed
                    )
                )
        except SimulationError as error:
            goal.abort()
            result.result = failure(error)
            return result
        goal.succeed()
        result.result.result = Result.RESULT_OK
        return result

    def _periods(self, steps: int) -> int:
        """Convert physics steps to control periods, or raise RequestError."""
        if self._world.state == State.PLAYING:
            raise RequestError(
                Result.RESULT_INCORRECT_STATE,
                'The simulation is running. Pause it before stepping it.',
            )
        return self._world.periods_of(steps)

    def _tell_world(self, _: Any, response: GetCurrentWorld.Response) -> None:
        """Report the world that is loaded."""
        response.world = _world_message(self._loaded)

    def _tell_worlds(
        self, request: GetAvailableWorlds.Request, response: GetAvailableWorlds.Response
    ) -> None:
        """List the installed worlds, and those in additional folders."""
        worlds = installed_worlds()
        for source in request.additional_sources:
            try:
                worlds.extend(worlds_in(source))
            except ResourceError:
                if not request.continue_on_error:
                    raise
        if not request.filter.tags:  # worlds have no tags
            response.worlds = [_world_message(world) for world in worlds]

    def _load(self, request: LoadWorld.Request, response: LoadWorld.Response) -> None:
        """Load another world."""
        with refusing_resource(LoadWorld.Response):
            world, scene = world_of(request.uri, request.resource_string)
        self._world.load(scene, self._keyframe)
        self._loaded = world
        response.world = _world_message(world)
        self._node.get_logger().info(
            f"Loaded the world '{world.name}'; paused until set_simulation_state starts it"
        )

    def _unload(self, _: Any, __: Any) -> None:
        """Reject the request: robots need a floor."""
        raise RequestError(
            Result.RESULT_FEATURE_UNSUPPORTED,
            "A world cannot be unloaded, because robots need a floor. Load the world 'flat' "
            'instead.',
        )

    def _push(self, request: ApplyWrench.Request) -> str:
        """Apply a wrench to a robot or an object."""
        self._world.refuse_after_failure()
        backend = self._world.backend
        backend.apply_wrench(
            backend.body(request.entity, request.body),
            vector(request.wrench.force),
            vector(request.wrench.torque),
            seconds(request.duration),
            vector(request.point),
        )
        return 'The push starts.'

    def _stand_up(self, robot: str, _: Trigger.Request) -> str:
        """Lift a robot onto its feet; its walker takes over when it stands."""
        self._world.refuse_after_failure()
        self._world.backend.hoist(robot)
        return 'The robot is being put onto its feet.'


def _tell_features(
    _: GetSimulatorFeatures.Request, response: GetSimulatorFeatures.Response
) -> GetSimulatorFeatures.Response:
    """Report the supported features; the only response without a result."""
    response.features = SimulatorFeatures(
        features=list(FEATURES), spawn_formats=list(THING_FORMATS), custom_info=_ABOUT
    )
    return response


def _world_message(world: LoadableWorld) -> WorldResource:
    """Build the message that describes a world."""
    return WorldResource(
        name=world.name,
        world_resource=Resource(uri=world.uri),
        description=world.description,
    )


def _answer(do: Any, request: Any, response: Any) -> Any:
    """Fill a response of our own interfaces: success, and a message."""
    try:
        response.message, response.success = do(request), True
    except SimulationError as error:
        response.message, response.success = str(error), False
    return response
