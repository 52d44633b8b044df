# SPDX-License-Identifier: Apache-2.0
"""The parameters of the simulator."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter, ParameterError
from humanoid_control.hosting.parameters import HostParameters
from humanoid_simulation.camera.parameters import CameraParameters
from humanoid_simulation.choosing import named
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.keyframes import load_keyframes
from humanoid_simulation.laser.parameters import LaserParameters
from humanoid_simulation.model.physics import SELF_COLLISIONS
from humanoid_simulation.noise_parameters import NoiseParameters

SLOWEST_FACTOR = 0.001
"""Minimum besides zero: anything slower would look like a simulator that hangs."""


@dataclass(frozen=True)
class SimulatorParameters(HostParameters, CameraParameters, LaserParameters, NoiseParameters):
    """World and time, besides the parameters of hosts, cameras, laser scanners and noise."""

    scene: str = parameter(
        'flat',
        'The scene: the name of an installed one, or the path of a file that ends with .yaml.',
        read_only=True,
    )
    real_time_factor: float = parameter(
        1.0,
        'How many seconds of the world pass in a real one; 0 is as fast as possible.',
        at_least=0.0,
        at_most=100.0,
    )
    start_paused: bool = parameter(
        False,
        'Wait at the start until set_simulation_state or step_simulation is called.',
        read_only=True,
    )
    reset_keyframe: str = parameter(
        'home', 'The posture, one of config/keyframes.yaml, in which robots begin after a reset.'
    )
    physics_rate_hz: float = parameter(
        500.0,
        'Physics steps in a second of the world; a multiple of control_rate_hz.',
        at_least=100.0,
        at_most=5000.0,
        read_only=True,
    )
    self_collision: str = parameter(
        'arms',
        'Which links of a robot collide with each other: arms with the body, legs as well, none.',
        choices=tuple(SELF_COLLISIONS),
        read_only=True,
    )
    start_x_m: float = parameter(
        0.0, 'Where the first robot begins.', at_least=-1000.0, at_most=1000.0, read_only=True
    )
    start_y_m: float = parameter(
        0.0, 'Where the first robot begins.', at_least=-1000.0, at_most=1000.0, read_only=True
    )
    start_yaw_rad: float = parameter(
        0.0, 'Where the robots look at first.', at_least=-7.0, at_most=7.0, read_only=True
    )
    spacing_m: float = parameter(
        1.0,
        'How far to the left of each other several robots begin.',
        at_least=0.5,
        at_most=100.0,
        read_only=True,
    )
    latency_periods: int = parameter(
        0,
        'How many control periods old the measurements are.',
        at_least=0,
        at_most=100,
        read_only=True,
    )
    extrapolation_s: float = parameter(
        0.03,
        'For how long targets that are not renewed go on with their velocity.',
        at_least=0.0,
        at_most=1.0,
        read_only=True,
    )
    clock_rate_hz: float = parameter(
        100.0, 'How often /clock is published.', at_least=1.0, at_most=500.0
    )
    ground_truth_rate_hz: float = parameter(
        50.0, 'How often ground_truth/odom is published; 0 is never.', at_least=0.0, at_most=500.0
    )
    wrench_rate_hz: float = parameter(
        50.0,
        'How often l_sole/wrench and r_sole/wrench are published; 0 is never.',
        at_least=0.0,
        at_most=500.0,
    )
    contacts_rate_hz: float = parameter(
        20.0, 'How often contacts is published; 0 is never.', at_least=0.0, at_most=500.0
    )
    world_frame_rate_hz: float = parameter(
        5.0,
        'How often the transform from odom to world is published, for viewers; 0 is never.',
        at_least=0.0,
        at_most=100.0,
    )
    walls_shown_up_to_m: float = parameter(
        0.4,
        'The height at which ground_truth/scene cuts walls, so that viewers see into the rooms.',
        at_least=0.0,
        at_most=100.0,
    )

    def __post_init__(self) -> None:
        """Check the keyframe, and constraints between parameters."""
        super().__post_init__()
        try:
            named('keyframe', self.reset_keyframe, load_keyframes())
        except SimulationError as error:
            raise ParameterError(str(error), 'reset_keyframe') from error
        if 0.0 < self.real_time_factor < SLOWEST_FACTOR:
            raise ParameterError(
                f"Parameter 'real_time_factor' is {self.real_time_factor:g}. Give "
                f'{SLOWEST_FACTOR:g} or more, or 0 for as fast as possible; the service '
                'set_simulation_state stops the time.',
                'real_time_factor',
            )
        steps = self.physics_rate_hz / self.control_rate_hz
        if steps < 1.0 or abs(steps - round(steps)) > 1e-6:
            raise ParameterError(
                f"Parameter 'physics_rate_hz' is {self.physics_rate_hz:g}, which is no multiple "
                f"of 'control_rate_hz', {self.control_rate_hz:g}. Give a multiple.",
                'physics_rate_hz',
                'control_rate_hz',
            )

    @property
    def steps_per_period(self) -> int:
        """Return the number of physics steps in a control period."""
        return round(self.physics_rate_hz / self.control_rate_hz)
