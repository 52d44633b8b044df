# SPDX-License-Identifier: Apache-2.0
"""Node that simulates robots in a world and runs their controllers."""

from __future__ import annotations

from collections.abc import Mapping
import time
from typing import Any

from humanoid_common.errors import UserError
from humanoid_common.node_parameters import NodeParameters
from humanoid_control.backends import Observation
from humanoid_control.hosting.diagnostics import DuplicatePublisherCheck, HostDiagnostics, Speed
from humanoid_control.hosting.host import Host
from humanoid_control.hosting.hosted_robots import HostedRobots
from humanoid_control.hosting.reports import Refusals
from humanoid_control.hosting.topics.filling import topic
from humanoid_simulation.camera.topics import CameraTopics
from humanoid_simulation.entity_services import EntityServices
from humanoid_simulation.model.description import in_world
from humanoid_simulation.pacing import Pacer
from humanoid_simulation.simulated_robots import simulated_robots, SimulatedRobots
from humanoid_simulation.simulated_world import GuardedLoop, SimulatedWorld
from humanoid_simulation.simulation_services import SimulationServices
from humanoid_simulation.simulator_parameters import SimulatorParameters
from humanoid_simulation.topics.scan import FRAME, ScanTopics
from humanoid_simulation.topics.world import RealTimeFactorTopic, WorldTopics
from rclpy.node import Node


class Simulator(Node):
    """
    Hosts a world with robots and their controllers, in lockstep.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('simulator', **options)
        self._settings = NodeParameters(self, SimulatorParameters, self._change)
        parameters = self._settings.current
        simulated = self._build(parameters)
        self._backend = backend = simulated.backend
        hardware = 'humanoid_simulation/MujocoBackend'
        self._robots = HostedRobots(self, simulated.controls, parameters, hardware)
        self._world = WorldTopics(self, simulated, parameters)
        self._cameras = CameraTopics(
            self,
            {name: backend.camera(name) for name in backend.robots},
            backend.model,
            parameters,
            parameters.prefix,
            parameters.picture_noise,
        )
        self._scans = ScanTopics(
            self,
            {name: in_world(name, f'{parameters.prefix}{FRAME}') for name in backend.robots},
            backend.model,
            parameters,
            parameters.prefix,
            parameters.scan_noise,
        )
        self._see()
        brains = {name: robot.control for name, robot in simulated.controls.items()}
        loop = GuardedLoop(backend, brains, self._fail)
        self._pacer = Pacer(backend.period_s, parameters.real_time_factor, time.monotonic())
        self._host = Host(
            self, loop, self._pacer, self._pacer.interval_s, self._robots.look, self._tell
        )
        self._host.pause(parameters.start_paused)
        world = SimulatedWorld(
            backend, loop, self._host, parameters.steps_per_period, self._follow_scene
        )
        self._simulation_services = SimulationServices(self, world, parameters)
        self._entity_services = EntityServices(self, world)
        self._factor_topic = RealTimeFactorTopic(self, self._speed)
        joint_states = [topic(name, 'joint_states') for name in backend.robots]
        self._duplicates = DuplicatePublisherCheck(self, ['/clock', *joint_states])
        self._diagnostics = HostDiagnostics(self, self._host, self._robots, self._speed)
        self.get_logger().info(_greeting(simulated, parameters))

    @property
    def camera_process_id(self) -> int | None:
        """Return the process id of the render process of the cameras, if it runs."""
        return self._cameras.process_id

    def destroy_node(self) -> None:
        """Destroy the node, and end the render process."""
        self._cameras.close()
        super().destroy_node()

    def _build(self, parameters: SimulatorParameters) -> SimulatedRobots:
        """Build the world, or raise UserError."""
        try:
            return simulated_robots(parameters, Refusals(self.get_logger().error).add)
        except UserError as error:
            raise UserError(f'The simulator cannot start. {error}') from error

    def _tell(self, observations: Mapping[str, Observation]) -> None:
        """Publish what is due after a period; nothing at time zero, which is unset time in ROS."""
        if next(iter(observations.values())).time_s <= 0.0:
            return
        self._world.tell(observations)
        self._robots.tell(observations)
        self._scans.tell(self._backend.time_s, self._backend.data)
        self._see()

    def _see(self) -> None:
        """Tick the cameras with the current state of the world."""
        time_ns = round(self._backend.time_s * 1e9)
        self._cameras.tick(time.monotonic(), time_ns, self._backend.data)

    def _follow_scene(self) -> None:
        """Update viewers and sensors after the backend has changed the scene."""
        self._world.change_scene()
        self._cameras.change_model(self._backend.model)
        self._scans.change_model(self._backend.model)
        self._see()

    def _speed(self) -> Speed | None:
        """Return the real-time factors; None in a pause, and at the start."""
        reached = self._pacer.reached
        if reached is None or self._host.paused:
            return None
        return Speed(reached, self._pacer.factor)

    def _fail(self, sentence: str) -> None:
        """Log an error of the physics, and pause."""
        self.get_logger().error(sentence)
        self._host.pause(True)

    def _change(self, parameters: SimulatorParameters) -> None:
        """Apply changed parameters."""
        self._robots.change(parameters)
        self._world.change(parameters)
        self._scans.change(parameters)
        self._simulation_services.change(parameters)
        if parameters.real_time_factor != self._pacer.factor:
            self._pacer.change(parameters.real_time_factor, time.monotonic())
            self._host.change(self._pacer.interval_s)


def _greeting(simulated: SimulatedRobots, parameters: SimulatorParameters) -> str:
    """Compose the log message at the start."""
    robots = ', '.join(simulated.backend.robots) or 'one robot'
    factor = parameters.real_time_factor
    pace = f'at {factor:g} times real time' if factor else 'as fast as possible'
    return (
        f"Simulator started: {robots} in the scene '{parameters.scene}', physics at "
        f'{parameters.physics_rate_hz:g} Hz, control at {parameters.control_rate_hz:g} Hz, {pace}'
    )
