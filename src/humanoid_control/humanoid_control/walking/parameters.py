# SPDX-License-Identifier: Apache-2.0
"""The numbers of the gait."""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace
from typing import Any

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.velocity_command import VelocityCommand, VelocityLimits


def _growing(power: float, value: float) -> Any:
    """Return a field that grows with a power of the robot's size."""
    return field(default=value, metadata={'power': power})


def _length(value: float) -> Any:
    return _growing(1.0, value)


def _time(value: float) -> Any:
    return _growing(0.5, value)


def _speed(value: float) -> Any:
    return _growing(0.5, value)


def _rate(value: float) -> Any:
    return _growing(-0.5, value)


@dataclass(frozen=True)
class WalkParameters:
    """
    The gait of the robot at scale 1; `scaled` gives that of another size.

    A robot of scale s is dynamically similar: times grow with sqrt(s), lengths with s, speeds
    with sqrt(s) (Froude's law; humanoid_description/config/scaling.yaml says more).
    """

    # Rhythm.
    swing_s: float = _time(0.36)
    """How long one foot alone carries the robot in a step."""
    shift_s: float = _time(0.10)
    """How long the weight takes from foot to foot, both on the ground."""
    first_shift_s: float = _time(0.5)
    """The same for the first step from standing."""
    reactive_shift_s: float = _time(0.04)
    """The same for a step that catches a push."""
    stop_s: float = _time(0.5)
    """How long the weight takes to the middle between the feet at the end."""

    # Footsteps.
    step_width_m: float = _length(0.18)
    """The distance of the feet sideways."""
    least_width_m: float = _length(0.14)
    most_width_m: float = _length(0.42)
    most_length_m: float = _length(0.32)
    """How far a foot may land before or behind the other one when it has to catch the robot."""
    preview_steps: int = 4
    """How many steps the plan looks ahead, the present one among them."""
    course_gain: float = 0.5
    """How much of the way back to its course the robot goes in a step."""
    course_distance_m: float = _length(0.06)
    """How far from its course it may be; what is more is forgotten."""
    course_turn_rad: float = 0.15
    parallel_length_m: float = _length(0.025)
    """How far from side by side feet may be that the robot stops on."""
    parallel_width_m: float = _length(0.03)
    parallel_turn_rad: float = 0.06

    # Velocity.
    forward_limit_m_s: float = _speed(0.5)
    backward_limit_m_s: float = _speed(0.3)
    left_limit_m_s: float = _speed(0.2)
    turn_limit_rad_s: float = _rate(1.0)
    sum_of_shares: float = 1.5
    """What the shares of the limits may come to together."""
    forward_acceleration_m_s2: float = 0.4
    left_acceleration_m_s2: float = 0.2
    turn_acceleration_rad_s2: float = _growing(-1.0, 0.8)

    # Posture.
    crouch_m: float = _length(0.05)
    """How far the hips hang below stretched legs."""
    leg_reach: float = 0.97
    """To which share of its length a leg on the ground is stretched before the pelvis sinks."""
    zmp_forward_m: float = _length(0.015)
    """Where under a foot its load is planned: before the sole's frame ..."""
    zmp_inward_m: float = _length(0.005)
    """... and on the inner side."""
    margin_length_m: float = _length(0.01)
    """What the load keeps from toe and heel ..."""
    margin_width_m: float = _length(0.008)
    """... and from the sides."""
    elbow_rad: float = -0.5
    shoulder_roll_rad: float = 0.12
    """How far the left arm is held from the body; the right one mirrors it."""

    # How a robot that stands may hold its body.
    bend_rad: float = 0.5
    """How far it bends forward at most ..."""
    bend_back_rad: float = 0.1
    """... and back, ..."""
    bend_rad_s: float = _rate(0.4)
    """... and how fast."""
    lower_m: float = _length(0.12)
    """How far it lowers its centre of mass at most ..."""
    lower_m_s: float = _speed(0.1)
    """... and how fast."""
    upright_pitch_rad: float = 0.03
    """A robot that is bent by less, ..."""
    upright_height_m: float = _length(0.01)
    """... and lowered by less, may step."""

    # Balance.
    dcm_gain: float = 1.6
    """How many times the error of the divergent component the zero-moment point moves."""
    observer_rate_1_s: float = _rate(60.0)
    """How fast the estimate of the centre of mass takes over what is measured."""
    reference_leak_1_s: float = _rate(8.0)
    """How fast its reference returns to the estimate."""
    reference_distance_m: float = _length(0.04)
    """How far the reference may be from the estimate."""
    attitude_stiffness_nm_rad: float = _growing(4.0, 400.0)
    attitude_damping_nms_rad: float = _growing(4.5, 25.0)
    ground_turn_nm: float = _growing(4.0, 15.0)
    """The torque about the vertical that the feet may exert on the ground."""
    heading_share: float = 0.5
    """How much of them there is against errors of the heading."""
    push_forward_m: float = _length(0.065)
    """A standing robot steps if its divergent component is farther than this from the middle."""
    push_left_m: float = _length(0.085)
    stop_error_m: float = _length(0.04)
    """It does not stop before the error of its divergent component is below this."""

    # Step adjustment.
    adjust_until_s: float = _time(0.06)
    """Before a landing its place does not change any more."""
    adjust_dead_band_m: float = _length(0.005)
    hurry_error_m: float = _length(0.06)
    """From which error on a step may be hurried to catch the robot."""
    hurry_rates: tuple[float, ...] = (1.0, 1.3, 1.6, 2.0)
    unreachable_length_m: float = _length(0.02)
    """A landing that has to be cut by more than this calls for hurry."""
    unreachable_width_m: float = _length(0.03)

    # Swing foot.
    swing_height_m: float = _length(0.055)
    early_arrival: float = 0.94
    """At which share of the swing the foot is above its landing."""
    reach_down_m_s: float = _speed(0.2)
    """How fast it goes on down when the ground is late."""
    deepest_m: float = _length(0.06)
    """How far below the expected ground it goes."""
    longest_tick_s: float = _time(0.04)
    """When control was away for longer, the foot in the air has not gone on as planned."""
    touchdown_phase: float = 0.5
    """From which share of the swing on a foot that meets something stays there."""
    touchdown_load: float = 0.12
    """How much of the weight it has to carry for that ..."""
    touch_load: float = 0.06
    """... and how much near the end of the swing, ..."""
    lost_load: float = 0.03
    """A foot with less than this for a while has lost what it met, and swings on ..."""
    lost_s: float = _time(0.025)
    """... after so long; ..."""
    least_swing_s: float = _time(0.08)
    """... with less time than this it goes straight down."""
    gentle_phase: float = 0.75
    """... which begins at this share."""
    landing_phase: float = 0.85
    """From which share of the swing on a foot that stands may take the weight."""
    late_touchdown_s: float = _time(0.16)
    """How late a landing may be until the step ends without it."""

    # Ground that is not level.
    conform_early_1_s: float = _rate(25.0)
    """How fast a sole with weight on it gives way to the tilt of the ground at first ..."""
    conform_early_s: float = _time(0.15)
    """... for so long, ..."""
    conform_1_s: float = _rate(10.0)
    """... and later."""
    conform_load: float = 0.4
    """The share of the weight at which it does so fully; with less it is stiffer."""
    conform_height_1_s: float = _rate(10.0)
    """How fast a foot without weight on it gives way to the height of the ground."""
    press_m_s: float = _speed(0.1)
    """How fast a foot that only touches is pressed down."""
    most_tilt_rad: float = 0.2
    """Ground that is steeper is taken for so steep."""
    slope_share: float = 0.5
    """How much of the tilt under a foot is expected of the ground ahead."""
    level_rate_1_s: float = _rate(6.0)
    """How fast the height of the pelvis follows that of the feet ..."""
    level_leak_1_s: float = _rate(8.0)
    """... and gives way to where it is measured, ..."""
    level_distance_m: float = _length(0.04)
    """... by so much at most."""
    level_tolerance_m: float = _length(0.005)
    """Footholds whose heights differ by less are one level floor for odometry."""

    # Falls.
    fall_tilt_rad: float = 0.6
    """A robot that leans more than this falls ..."""
    fall_foresight_s: float = _time(0.2)
    """... or one that will so soon."""
    fall_height: float = 0.7
    """So does one whose base is lower than this share of its height when it stands."""
    upright_tilt_rad: float = 0.3
    """A robot that leans less, its legs below it, is held by somebody and can stand up."""
    collapse_s: float = _time(1.5)
    """How long a fall is made soft; then the joints are loose."""
    collapse_stiffness: float = 0.15
    """The share of their stiffness with which the joints pull meanwhile."""
    stand_up_s: float = _time(1.5)
    """How long the joints take to the posture of standing."""
    standing_load: float = 0.6
    """The share of the weight on the soles at which a robot that has stood up walks again."""

    # Obstacles.
    force_rate_1_s: float = _rate(8.0)
    """How fast the estimate of forces from outside follows."""
    bump_ns: float = _growing(3.5, 12.0)
    """The impulse against its motion from which on the robot takes its way for blocked ..."""
    bump_memory_s: float = _time(0.8)
    """... and how long an impulse is remembered."""
    turn_back_m_s: float = _speed(0.8)
    """How fast the foot in the air goes to where it lands instead."""
    keep_off_m: float = _length(0.01)
    """How far from where a foot has met something the feet stay ..."""
    keep_off_slope: float = 0.15
    """... and how much of their distance aside less: its direction is known about so well."""
    touch_rate_1_s: float = _rate(16.0)
    """How fast the estimate of what limbs touch follows."""
    touch_load_rate_1_s: float = _rate(1.5)
    """How fast what an arm feels while the robot stands becomes a load that it carries."""
    touch_gap_s: float = _time(0.025)
    """Observations that are farther apart say nothing of what limbs touch."""
    leg_touch_nm: float = _growing(4.0, 16.0)
    """The moment about its hip, against the motion, at which a leg in the air has met something:
    forwards or backwards ..."""
    leg_touch_aside_nm: float = _growing(4.0, 10.0)
    """... and to the side, where a step needs less ..."""
    leg_touch_from_phase: float = 0.1
    """... if the foot has left the ground for this share of the swing."""
    arm_touch_nm: float = _growing(4.0, 4.0)
    """The moment about its shoulder at which an arm has met something."""
    retreat_m_s: float = _speed(0.12)
    """How fast the robot steps back from an obstacle ..."""
    retreat_m: float = _length(0.12)
    """... and how far, ..."""
    lean_m: float = _length(0.03)
    """It does not step back while the divergent component is so far off towards the obstacle."""
    retreat_s: float = _time(4.0)
    """... for at most so long."""
    let_go_s: float = _time(0.5)
    """For how long nobody has to want to go there until it may try again."""
    forget_m: float = _length(0.5)
    """So far from an obstacle it no longer counts."""

    # Joints.
    velocity_limit_rad_s: float = _rate(12.0)
    acceleration_limit_rad_s2: float = _growing(-1.0, 250.0)
    arm_swing: float = 1.0
    """How many radians a shoulder turns for a foot that is a leg's length ahead."""

    def scaled(self, scale: float) -> WalkParameters:
        """
        Scale the gait to a robot of another size (Froude similarity).

        Parameters
        ----------
        scale
            The size of that robot, relative to the one of these parameters.

        Returns
        -------
        WalkParameters
            The gait of that robot; this one stays as it is.

        Raises
        ------
        WalkingError
            The scale is not positive and finite.

        """
        if not (0.0 < scale < float('inf')):
            raise WalkingError(f'The scale {scale:g} is not a size. Give one as 0.65.')
        grown = {
            entry.name: getattr(self, entry.name) * scale ** entry.metadata['power']
            for entry in fields(self)
            if 'power' in entry.metadata
        }
        return replace(self, **grown)

    @property
    def step_s(self) -> float:
        """Return the time from step to step."""
        return self.shift_s + self.swing_s

    @property
    def velocity_limits(self) -> VelocityLimits:
        """Return the speeds that the gait can do."""
        return VelocityLimits(
            self.forward_limit_m_s,
            self.backward_limit_m_s,
            self.left_limit_m_s,
            self.turn_limit_rad_s,
            self.sum_of_shares,
        )

    def velocity_change(self, time_s: float) -> VelocityCommand:
        """
        Compute the largest change of the velocity in a given time.

        Parameters
        ----------
        time_s
            How long the robot accelerates at its limits.

        Returns
        -------
        VelocityCommand
            The largest change of each component.

        """
        return VelocityCommand(
            self.forward_acceleration_m_s2 * time_s,
            self.left_acceleration_m_s2 * time_s,
            self.turn_acceleration_rad_s2 * time_s,
        )
