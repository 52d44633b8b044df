# SPDX-License-Identifier: Apache-2.0
"""The parameters of the simulator: its world and time, its cameras, laser scanners and noise."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter, ParameterError
from humanoid_control.hosting.parameters import HostParameters
from humanoid_simulation.backend.noise import REALISTIC, SensorNoise
from humanoid_simulation.camera.images import PictureNoise
from humanoid_simulation.camera.methods import AUTO, CHOICES
from humanoid_simulation.errors import named, SimulationError
from humanoid_simulation.keyframes import load_keyframes
from humanoid_simulation.laser_scanner import ScanNoise, ScanPattern
from humanoid_simulation.model.description import SELF_COLLISIONS

SLOWEST_FACTOR = 0.001
"""Minimum besides zero: anything slower would look like a simulator that hangs."""


@dataclass(frozen=True)
class CameraParameters:
    """Rate, image size, frame and rendering method of the cameras of all robots."""

    camera_rate_hz: float = parameter(
        10.0,
        'How many images each camera takes per second of simulated time; 0 for no cameras.',
        at_least=0.0,
        at_most=100.0,
        read_only=True,
    )
    camera_width_px: int = parameter(
        320, 'The width of the images.', at_least=16, at_most=1920, read_only=True
    )
    camera_height_px: int = parameter(
        240, 'The height of the images.', at_least=16, at_most=1920, read_only=True
    )
    camera_frame: str = parameter(
        'camera_optical_frame',
        'The frame of the images, without the prefix of the robot.',
        read_only=True,
    )
    camera_renderer: str = parameter(
        AUTO,
        'How images are rendered: egl or osmesa (OpenGL), or rays, without OpenGL; auto '
        'tries all three.',
        choices=CHOICES,
        read_only=True,
    )


@dataclass(frozen=True)
class LaserParameters:
    """Rate, rays and range of the laser scanners; their noise is with that of other sensors."""

    scan_rate_hz: float = parameter(
        10.0,
        'How often scan is published while it has subscribers; 0 is never.',
        at_least=0.0,
        at_most=100.0,
    )
    scan_rays: int = parameter(
        360, 'The number of rays in a full sweep.', at_least=4, at_most=4096, read_only=True
    )
    scan_range_min_m: float = parameter(
        0.1, 'The minimum range.', at_least=0.0, at_most=0.9, read_only=True
    )
    scan_range_max_m: float = parameter(
        12.0, 'The maximum range.', at_least=1.0, at_most=100.0, read_only=True
    )

    @property
    def scan_pattern(self) -> ScanPattern:
        """Return the scan pattern that the parameters describe."""
        return ScanPattern(self.scan_rays, self.scan_range_min_m, self.scan_range_max_m)


def _deviation(default: float, of_what: str) -> float:
    """Declare the parameter of a standard deviation."""
    return parameter(
        default,
        f'Standard deviation of {of_what}, at sensor_noise 1.',
        at_least=0.0,
        at_most=1000.0,
        read_only=True,
    )


@dataclass(frozen=True)
class NoiseParameters:
    """Noise of all sensors: joints, inertial measurement unit, feet, cameras and scanners."""

    sensor_noise: float = parameter(
        0.0,
        'Factor on all sensor noise: 0 is none, 1 is what the other parameters say.',
        at_least=0.0,
        at_most=100.0,
        read_only=True,
    )
    seed: int = parameter(0, 'Seed of the noise.', at_least=0, at_most=2**31 - 1, read_only=True)
    joint_position_noise_rad: float = _deviation(REALISTIC.position_rad, 'joint positions')
    joint_velocity_noise_rad_s: float = _deviation(REALISTIC.velocity_rad_s, 'joint velocities')
    joint_effort_noise_nm: float = _deviation(REALISTIC.effort_nm, 'joint efforts')
    imu_tilt_noise_rad: float = _deviation(REALISTIC.tilt_rad, 'roll and pitch')
    imu_rate_noise_rad_s: float = _deviation(
        REALISTIC.angular_velocity_rad_s, 'angular velocities'
    )
    imu_rate_bias_rad_s: float = _deviation(
        REALISTIC.angular_velocity_bias_rad_s, 'the bias of angular velocities'
    )
    imu_acceleration_noise_m_s2: float = _deviation(REALISTIC.acceleration_m_s2, 'accelerations')
    imu_acceleration_bias_m_s2: float = _deviation(
        REALISTIC.acceleration_bias_m_s2, 'the bias of accelerations'
    )
    foot_force_noise_n: float = _deviation(REALISTIC.foot_force_n, 'the forces on the feet')
    foot_torque_noise_nm: float = _deviation(REALISTIC.foot_torque_nm, 'the torques on the feet')

    camera_color_noise: float = _deviation(2.0, 'red, green and blue, on a scale of 255')
    camera_depth_noise_m: float = _deviation(
        0.002, 'depth at a distance of 1 m (it grows with the square of the distance)'
    )
    scan_range_noise_m: float = _deviation(0.01, 'the ranges of the laser scanner')
    scan_dropout_share: float = parameter(
        0.002,
        'Fraction of laser scanner rays without a return, at sensor_noise 1.',
        at_least=0.0,
        at_most=1.0,
        read_only=True,
    )

    @property
    def picture_noise(self) -> PictureNoise:
        """Return the noise of the cameras that the parameters describe."""
        return PictureNoise(
            color=self.camera_color_noise * self.sensor_noise,
            depth_1_m=self.camera_depth_noise_m * self.sensor_noise,
            seed=self.seed,
        )

    @property
    def scan_noise(self) -> ScanNoise:
        """Return the noise of the laser scanners that the parameters describe."""
        return ScanNoise(
            range_m=self.scan_range_noise_m * self.sensor_noise,
            dropout_share=min(self.scan_dropout_share * self.sensor_noise, 1.0),
            seed=self.seed,
        )

    @property
    def noise(self) -> SensorNoise:
        """Return the noise of the other sensors that the parameters describe."""
        return SensorNoise(
            position_rad=self.joint_position_noise_rad,
            velocity_rad_s=self.joint_velocity_noise_rad_s,
            effort_nm=self.joint_effort_noise_nm,
            tilt_rad=self.imu_tilt_noise_rad,
            angular_velocity_rad_s=self.imu_rate_noise_rad_s,
            acceleration_m_s2=self.imu_acceleration_noise_m_s2,
            foot_force_n=self.foot_force_noise_n,
            foot_torque_nm=self.foot_torque_noise_nm,
            angular_velocity_bias_rad_s=self.imu_rate_bias_rad_s,
            acceleration_bias_m_s2=self.imu_acceleration_bias_m_s2,
        ).scaled(self.sensor_noise)


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
        'Seconds of simulated time per real second; 0 is as fast as possible.',
        at_least=0.0,
        at_most=100.0,
    )
    start_paused: bool = parameter(
        False,
        'Start paused, until set_simulation_state or step_simulation is called.',
        read_only=True,
    )
    reset_keyframe: str = parameter(
        'home', 'The posture in which robots start after a reset, one of config/keyframes.yaml.'
    )
    physics_rate_hz: float = parameter(
        500.0,
        'Physics steps per second of simulated time; a multiple of control_rate_hz.',
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
        0.0, 'The initial x of the first robot.', at_least=-1000.0, at_most=1000.0, read_only=True
    )
    start_y_m: float = parameter(
        0.0, 'The initial y of the first robot.', at_least=-1000.0, at_most=1000.0, read_only=True
    )
    start_yaw_rad: float = parameter(
        0.0, 'The initial heading of the robots.', at_least=-7.0, at_most=7.0, read_only=True
    )
    spacing_m: float = parameter(
        1.0,
        'How far to the left of each other several robots start.',
        at_least=0.5,
        at_most=100.0,
        read_only=True,
    )
    latency_periods: int = parameter(
        0,
        'The age of the measurements, in control periods.',
        at_least=0,
        at_most=100,
        read_only=True,
    )
    extrapolation_s: float = parameter(
        0.03,
        'How long targets that are not renewed are extrapolated at their velocity.',
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
                'set_simulation_state pauses the simulation.',
                'real_time_factor',
            )
        steps = self.physics_rate_hz / self.control_rate_hz
        if steps < 1.0 or abs(steps - round(steps)) > 1e-6:
            raise ParameterError(
                f"Parameter 'physics_rate_hz' is {self.physics_rate_hz:g}, which is not a "
                f"multiple of 'control_rate_hz', {self.control_rate_hz:g}. Give a multiple.",
                'physics_rate_hz',
                'control_rate_hz',
            )

    @property
    def steps_per_period(self) -> int:
        """Return the number of physics steps in a control period."""
        return round(self.physics_rate_hz / self.control_rate_hz)
