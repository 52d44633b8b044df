# SPDX-License-Identifier: Apache-2.0
"""Gait parameters of undisturbed walking on level ground, and of the posture of the robot."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter
from humanoid_description.similarity import (
    angular_acceleration,
    duration,
    fixed,
    length,
    rate,
    share,
    speed,
)


@dataclass(frozen=True)
class TimingParameters:
    """Durations of single and double support."""

    swing_s: float = duration(0.36, 'Duration of single support: one foot carries the robot.')
    shift_s: float = duration(0.10, 'Duration of double support, in which the weight shifts.')
    first_shift_s: float = duration(
        0.5, 'Duration of double support before the first step from standing.'
    )
    reactive_shift_s: float = duration(
        0.04, 'Duration of double support before a step that catches a push.'
    )
    stop_s: float = duration(
        0.5, 'Time in which the weight comes to rest between the feet after the last step.'
    )

    @property
    def step_s(self) -> float:
        """Return the duration of a step: double support, then single support."""
        return self.shift_s + self.swing_s


@dataclass(frozen=True)
class FootstepParameters:
    """Limits of footsteps, preview, and tracking of the reference path."""

    width_m: float = length(0.18, 'Lateral distance between the feet.')
    least_width_m: float = length(0.14, 'Minimum lateral distance between the feet.')
    most_width_m: float = length(0.42, 'Maximum lateral distance between the feet.')
    most_length_m: float = length(
        0.32, 'How far a foot may land ahead of or behind the other to catch the robot.'
    )
    preview_steps: int = parameter(
        4,
        'Number of steps in the preview, including the current one.',
        at_least=2,
        at_most=10,
        read_only=True,
    )
    path_gain: float = share(
        0.5, 'Share of the deviation from the reference path that is corrected in a step.'
    )
    path_distance_m: float = length(
        0.06, 'Maximum deviation from the reference path; the path is shifted by any excess.'
    )
    path_turn_rad: float = fixed(
        0.15, 'Maximum heading error to the reference path; the path is turned by any excess.'
    )
    parallel_length_m: float = length(
        0.025, 'How far one foot may be ahead of the other when the robot stops.'
    )
    parallel_width_m: float = length(
        0.03, 'How far the distance of the feet may be off when the robot stops.'
    )
    parallel_turn_rad: float = fixed(
        0.06, 'How far the feet may be turned towards each other when the robot stops.'
    )


@dataclass(frozen=True)
class VelocityParameters:
    """Limits of the velocity and the acceleration of the gait."""

    forward_limit_m_s: float = speed(0.5, 'Maximum forward velocity.')
    backward_limit_m_s: float = speed(0.3, 'Maximum backward velocity.')
    left_limit_m_s: float = speed(0.2, 'Maximum lateral velocity.')
    turn_limit_rad_s: float = rate(1.0, 'Maximum yaw rate.')
    sum_of_shares: float = fixed(
        1.5, 'Maximum sum of the three components, each as a share of its limit.'
    )
    forward_acceleration_m_s2: float = fixed(0.4, 'Maximum acceleration along x.')
    left_acceleration_m_s2: float = fixed(0.2, 'Maximum acceleration along y.')
    turn_acceleration_rad_s2: float = angular_acceleration(0.8, 'Maximum yaw acceleration.')


@dataclass(frozen=True)
class PostureParameters:
    """Posture of the robot while it stands and walks."""

    crouch_m: float = length(0.05, 'How far the hips are below their height on straight legs.')
    leg_reach: float = share(
        0.97, 'Share of its length to which a stance leg is stretched before the pelvis sinks.'
    )
    zmp_forward_m: float = length(
        0.015, 'How far ahead of the sole frame the ZMP of a foot is planned.'
    )
    zmp_inward_m: float = length(
        0.005, 'How far to the inner side of the sole frame the ZMP of a foot is planned.'
    )
    margin_length_m: float = length(
        0.01, 'Distance that the centre of pressure keeps from toe and heel.'
    )
    margin_width_m: float = length(
        0.008, 'Distance that the centre of pressure keeps from the sides of the foot.'
    )
    elbow_rad: float = parameter(
        -0.5, 'Angle of both elbows.', at_least=-2.0, at_most=0.0, read_only=True
    )
    shoulder_roll_rad: float = fixed(
        0.12, 'How far the left arm is held from the body; the right one mirrors it.'
    )
    arm_swing: float = parameter(
        1.0,
        "Shoulder angle in rad for the opposite foot a leg's length ahead; 0 is no swing.",
        at_least=0.0,
        at_most=2.0,
        read_only=True,
    )


@dataclass(frozen=True)
class BodyPoseParameters:
    """Limits and rates of the commanded body pose of a standing robot."""

    bend_rad: float = fixed(0.5, 'Maximum forward pitch.')
    bend_back_rad: float = fixed(0.1, 'Maximum backward pitch.')
    bend_rad_s: float = rate(0.4, 'Maximum pitch rate.')
    lower_m: float = length(0.12, 'Maximum lowering of the centre of mass.')
    lower_m_s: float = speed(0.1, 'Maximum velocity of that lowering.')
    upright_pitch_rad: float = fixed(0.03, 'Pitch below which the robot may step.')
    upright_height_m: float = length(
        0.01, 'Lowering of the centre of mass below which the robot may step.'
    )


@dataclass(frozen=True)
class SwingParameters:
    """Swing foot trajectory, and detection of touchdown."""

    height_m: float = length(0.055, 'How high the swing foot is lifted.')
    early_arrival: float = share(
        0.94, 'Share of the swing at which the foot is above its landing.'
    )
    reach_down_m_s: float = speed(0.2, 'Downward velocity when touchdown is late.')
    deepest_m: float = length(0.06, 'How far below the expected ground the foot reaches.')
    longest_tick_s: float = duration(
        0.04,
        'Gap between two control periods after which the swing continues from the actual foot.',
    )
    touchdown_phase: float = share(
        0.5, 'Share of the swing after which a foot that meets something stays there.'
    )
    touchdown_load: float = share(
        0.12, 'Share of the weight that the foot must carry to stay there.'
    )
    touch_load: float = share(
        0.06, 'Share of the weight that is enough for that near the end of the swing.'
    )
    lost_load: float = share(
        0.03, 'Share of the weight below which a landed foot has lost the ground.'
    )
    lost_s: float = duration(
        0.025, 'Time for which the load must be that small before the foot swings on.'
    )
    least_s: float = duration(
        0.08, 'Time left in the swing below which such a foot goes straight down.'
    )
    gentle_phase: float = share(0.75, 'Share of the swing after which the smaller load is enough.')
    landing_phase: float = share(
        0.85, 'Share of the swing after which a landed foot may take the weight.'
    )
    late_touchdown_s: float = duration(
        0.16, 'How late a landing may be before the step ends without it.'
    )


@dataclass(frozen=True)
class JointParameters:
    """Limits of the joint velocities and accelerations that the walk commands."""

    velocity_limit_rad_s: float = rate(12.0, 'Maximum joint velocity.')
    acceleration_limit_rad_s2: float = angular_acceleration(250.0, 'Maximum joint acceleration.')
