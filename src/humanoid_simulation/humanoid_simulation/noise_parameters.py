# SPDX-License-Identifier: Apache-2.0
"""The parameters of the sensor noise."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter
from humanoid_simulation.backend.noise import REALISTIC, SensorNoise
from humanoid_simulation.camera.picture_noise import PictureNoise
from humanoid_simulation.laser.scanner import ScanNoise


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
        'What all noise of sensors is multiplied by: 0 is none, 1 is what the others say.',
        at_least=0.0,
        at_most=100.0,
        read_only=True,
    )
    seed: int = parameter(0, 'Of the noise.', at_least=0, at_most=2**31 - 1, read_only=True)
    joint_position_noise_rad: float = _deviation(REALISTIC.position_rad, 'joint positions')
    joint_velocity_noise_rad_s: float = _deviation(REALISTIC.velocity_rad_s, 'joint velocities')
    joint_effort_noise_nm: float = _deviation(REALISTIC.effort_nm, 'joint efforts')
    imu_tilt_noise_rad: float = _deviation(REALISTIC.tilt_rad, 'roll and pitch')
    imu_rate_noise_rad_s: float = _deviation(
        REALISTIC.angular_velocity_rad_s, 'angular velocities'
    )
    imu_rate_bias_rad_s: float = _deviation(
        REALISTIC.angular_velocity_bias_rad_s, 'the constant error of angular velocities'
    )
    imu_acceleration_noise_m_s2: float = _deviation(REALISTIC.acceleration_m_s2, 'accelerations')
    imu_acceleration_bias_m_s2: float = _deviation(
        REALISTIC.acceleration_bias_m_s2, 'the constant error of accelerations'
    )
    foot_force_noise_n: float = _deviation(REALISTIC.foot_force_n, 'the forces on the feet')
    foot_torque_noise_nm: float = _deviation(REALISTIC.foot_torque_nm, 'the torques on the feet')

    camera_color_noise: float = _deviation(2.0, 'red, green and blue, of 255')
    camera_depth_noise_m: float = _deviation(
        0.002, 'depth at a distance of 1 m, and with the square of the distance'
    )
    scan_range_noise_m: float = _deviation(0.01, 'the ranges of the laser scanner')
    scan_dropout_share: float = parameter(
        0.002,
        'Share of rays of the laser scanner that bring nothing back, at sensor_noise 1.',
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
