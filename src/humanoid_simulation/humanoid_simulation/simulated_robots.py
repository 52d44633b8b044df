# SPDX-License-Identifier: Apache-2.0
"""Build the world and the controllers of its robots from parameters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import math
import time

from humanoid_control.hosting.walking_robot import WalkingRobotControl
from humanoid_description.loading import load_robot
from humanoid_simulation.backend.mujoco_backend import MujocoBackend
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.keyframes import Keyframe, load_keyframes
from humanoid_simulation.model.description import humanoid, Physics, Placement, RobotDescription
from humanoid_simulation.scene.loading import load_scene
from humanoid_simulation.scene.scene import Scene
from humanoid_simulation.simulator_parameters import SimulatorParameters


@dataclass(frozen=True, eq=False)
class SimulatedRobots:
    """A world, and the controller of each of its robots, by name."""

    backend: MujocoBackend
    controls: dict[str, WalkingRobotControl]


def simulated_robots(
    parameters: SimulatorParameters, say: Callable[[str], None]
) -> SimulatedRobots:
    """
    Build the simulated world and a walking controller for each robot in it.

    Parameters
    ----------
    parameters : SimulatorParameters
        The parameters of the simulator node.
    say
        Called with a message when a controller is at fault.

    Returns
    -------
    SimulatedRobots
        The world, with all robots standing in the posture in which walking starts.

    Raises
    ------
    DescriptionError
        The model of the robot cannot be made.
    SimulationError
        The scene cannot be read, or the world cannot be simulated.

    """
    description = humanoid(parameters.scale, parameters.prefix, parameters.hands)
    model = load_robot(description.urdf, 'the humanoid')
    imu = parameters.noise.imu(_settings(parameters).period_s)
    walk = parameters.walk.scaled(parameters.scale)
    controls = {
        name: WalkingRobotControl.of(model, description.drives, walk, time.monotonic, say, imu=imu)
        for name in parameters.robots
    }
    scene = load_scene(parameters.scene)
    return SimulatedRobots(_backend(parameters, description, scene, controls), controls)


def _backend(
    parameters: SimulatorParameters,
    description: RobotDescription,
    scene: Scene,
    controls: dict[str, WalkingRobotControl],
) -> MujocoBackend:
    """Build the world; its keyframe `home` is the posture in which walking starts."""
    home = next(iter(controls.values())).home_rad
    unprefixed = {name.removeprefix(description.prefix): at for name, at in home.items()}
    return MujocoBackend(
        description,
        scene,
        _placements(parameters),
        _settings(parameters),
        load_keyframes() | {'home': Keyframe(unprefixed)},
    )


def _settings(parameters: SimulatorParameters) -> BackendSettings:
    """Build the settings of the backend."""
    return BackendSettings(
        Physics(1.0 / parameters.physics_rate_hz, parameters.self_collision),
        parameters.steps_per_period,
        parameters.noise,
        parameters.seed,
        parameters.latency_periods,
        parameters.extrapolation_s,
    )


def _placements(parameters: SimulatorParameters) -> list[Placement]:
    """Compute the initial poses of the robots, each to the left of the previous one."""
    yaw_rad = parameters.start_yaw_rad
    return [
        Placement(
            name,
            parameters.start_x_m - number * parameters.spacing_m * math.sin(yaw_rad),
            parameters.start_y_m + number * parameters.spacing_m * math.cos(yaw_rad),
            yaw_rad=yaw_rad,
        )
        for number, name in enumerate(parameters.robots)
    ]
