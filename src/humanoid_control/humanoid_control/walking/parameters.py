# SPDX-License-Identifier: Apache-2.0
"""Gait parameters, in groups of parameters that are tuned together."""

from __future__ import annotations

from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

from humanoid_common.errors import UserError
from humanoid_common.parameters import parameter, ParameterError

_POWER = 'humanoid_control.power'
"""Metadata key of the power of the robot's size with which a field scales."""
_MOST_CHANGE = 4.0
"""Factor by which a parameter may be above or below its default."""


class WalkingError(UserError):
    """An input that walking cannot handle; the message states which, and why."""


def _growing(power: float, value: float, description: str) -> float:
    """Declare a parameter that scales with a power of the robot's size."""
    return parameter(
        value,
        description,
        at_least=value / _MOST_CHANGE,
        at_most=value * _MOST_CHANGE,
        read_only=True,
        metadata={_POWER: power},
    )


def _fixed(value: float, description: str) -> float:
    """Declare a parameter that is the same for robots of all sizes."""
    return _growing(0.0, value, description)


def _share(value: float, description: str) -> float:
    """Declare a fraction, from 0.01 to 1."""
    return parameter(value, description, at_least=0.01, at_most=1.0, read_only=True)


def _length(value: float, description: str) -> float:
    return _growing(1.0, value, description)


def _time(value: float, description: str) -> float:
    return _growing(0.5, value, description)


def _speed(value: float, description: str) -> float:
    return _growing(0.5, value, description)


def _rate(value: float, description: str) -> float:
    return _growing(-0.5, value, description)


@dataclass(frozen=True)
class TimingParameters:
    """Durations of single and double support."""

    swing_s: float = _time(0.36, 'Duration of single support: one foot carries the robot.')
    shift_s: float = _time(0.10, 'Duration of double support, in which the weight shifts.')
    first_shift_s: float = _time(
        0.5, 'Duration of double support before the first step from standing.'
    )
    reactive_shift_s: float = _time(
        0.04, 'Duration of double support before a step that catches a push.'
    )
    stop_s: float = _time(
        0.5, 'Time in which the weight comes to rest between the feet after the last step.'
    )

    @property
    def step_s(self) -> float:
        """Return the duration of a step: double support, then single support."""
        return self.shift_s + self.swing_s


@dataclass(frozen=True)
class FootstepParameters:
    """Limits of footsteps, preview, and tracking of the reference path."""

    width_m: float = _length(0.18, 'Lateral distance between the feet.')
    least_width_m: float = _length(0.14, 'Minimum lateral distance between the feet.')
    most_width_m: float = _length(0.42, 'Maximum lateral distance between the feet.')
    most_length_m: float = _length(
        0.32, 'How far a foot may land ahead of or behind the other to catch the robot.'
    )
    preview_steps: int = parameter(
        4,
        'Number of steps in the preview, including the current one.',
        at_least=2,
        at_most=10,
        read_only=True,
    )
    path_gain: float = _share(
        0.5, 'Share of the deviation from the reference path that is corrected in a step.'
    )
    path_distance_m: float = _length(
        0.06, 'Maximum deviation from the reference path; the path is shifted by any excess.'
    )
    path_turn_rad: float = _fixed(
        0.15, 'Maximum heading error to the reference path; the path is turned by any excess.'
    )
    parallel_length_m: float = _length(
        0.025, 'How far one foot may be ahead of the other when the robot stops.'
    )
    parallel_width_m: float = _length(
        0.03, 'How far the distance of the feet may be off when the robot stops.'
    )
    parallel_turn_rad: float = _fixed(
        0.06, 'How far the feet may be turned towards each other when the robot stops.'
    )


@dataclass(frozen=True)
class VelocityParameters:
    """Limits of the velocity and the acceleration of the gait."""

    forward_limit_m_s: float = _speed(0.5, 'Maximum forward velocity.')
    backward_limit_m_s: float = _speed(0.3, 'Maximum backward velocity.')
    left_limit_m_s: float = _speed(0.2, 'Maximum lateral velocity.')
    turn_limit_rad_s: float = _rate(1.0, 'Maximum yaw rate.')
    sum_of_shares: float = _fixed(
        1.5, 'Maximum sum of the three components, each as a share of its limit.'
    )
    forward_acceleration_m_s2: float = _fixed(0.4, 'Maximum acceleration along x.')
    left_acceleration_m_s2: float = _fixed(0.2, 'Maximum acceleration along y.')
    turn_acceleration_rad_s2: float = _growing(-1.0, 0.8, 'Maximum yaw acceleration.')


@dataclass(frozen=True)
class PostureParameters:
    """Posture of the robot while it stands and walks."""

    crouch_m: float = _length(0.05, 'How far the hips are below their height on straight legs.')
    leg_reach: float = _share(
        0.97, 'Share of its length to which a stance leg is stretched before the pelvis sinks.'
    )
    zmp_forward_m: float = _length(
        0.015, 'How far ahead of the sole frame the ZMP of a foot is planned.'
    )
    zmp_inward_m: float = _length(
        0.005, 'How far to the inner side of the sole frame the ZMP of a foot is planned.'
    )
    margin_length_m: float = _length(
        0.01, 'Distance that the centre of pressure keeps from toe and heel.'
    )
    margin_width_m: float = _length(
        0.008, 'Distance that the centre of pressure keeps from the sides of the foot.'
    )
    elbow_rad: float = parameter(
        -0.5, 'Angle of both elbows.', at_least=-2.0, at_most=0.0, read_only=True
    )
    shoulder_roll_rad: float = _fixed(
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

    bend_rad: float = _fixed(0.5, 'Maximum forward pitch.')
    bend_back_rad: float = _fixed(0.1, 'Maximum backward pitch.')
    bend_rad_s: float = _rate(0.4, 'Maximum pitch rate.')
    lower_m: float = _length(0.12, 'Maximum lowering of the centre of mass.')
    lower_m_s: float = _speed(0.1, 'Maximum velocity of that lowering.')
    upright_pitch_rad: float = _fixed(0.03, 'Pitch below which the robot may step.')
    upright_height_m: float = _length(
        0.01, 'Lowering of the centre of mass below which the robot may step.'
    )


@dataclass(frozen=True)
class BalanceParameters:
    """Feedback control of the divergent component of motion (DCM) and of the attitude."""

    dcm_gain: float = _fixed(1.6, 'How far the ZMP moves, as a multiple of the DCM error.')
    observer_rate_1_s: float = _rate(60.0, 'Bandwidth of the estimate of the centre of mass.')
    reference_leak_1_s: float = _rate(
        8.0, 'Rate at which the reference of the centre of mass returns to the estimate.'
    )
    reference_distance_m: float = _length(
        0.04, 'Maximum distance along each axis of that reference from the estimate.'
    )
    attitude_stiffness_nm_rad: float = _growing(
        4.0, 400.0, 'Stiffness of the attitude of the trunk.'
    )
    attitude_damping_nms_rad: float = _growing(4.5, 25.0, 'Damping of the attitude of the trunk.')
    ground_turn_nm: float = _growing(4.0, 15.0, 'Maximum yaw torque of the feet on the ground.')
    heading_share: float = _share(
        0.5, 'Share of stiffness and damping that acts on heading errors.'
    )
    push_forward_m: float = _length(
        0.065, 'Distance of the DCM ahead of the middle at which a standing robot steps.'
    )
    push_left_m: float = _length(
        0.085, 'Distance of the DCM beside the middle at which a standing robot steps.'
    )
    stop_error_m: float = _length(0.04, 'DCM error below which the robot may stop.')


@dataclass(frozen=True)
class StepAdjustmentParameters:
    """Adjustment of the position and the timing of a landing to catch the robot."""

    until_s: float = _time(0.06, 'Time before a landing from which its position is fixed.')
    dead_band_m: float = _length(0.005, 'Adjustment below which the position is kept.')
    hurry_error_m: float = _length(0.06, 'DCM error above which a step may be sped up.')
    hurry_rates: tuple[float, ...] = parameter(
        (1.0, 1.3, 1.6, 2.0),
        'Speed-up factors of a step, slowest first.',
        at_least=1.0,
        at_most=3.0,
        read_only=True,
    )
    unreachable_length_m: float = _length(
        0.02, 'How much of the length of a step may be cut before it is sped up instead.'
    )
    unreachable_width_m: float = _length(
        0.03, 'How much of the width of a step may be cut before it is sped up instead.'
    )

    def __post_init__(self) -> None:
        """Check the rates."""
        if self.hurry_rates[0] != 1.0 or sorted(set(self.hurry_rates)) != [*self.hurry_rates]:
            raise ParameterError(
                f"Parameter 'hurry_rates' is {[*self.hurry_rates]}, but must start with 1.0 and "
                'increase from each rate to the next.',
                'hurry_rates',
            )


@dataclass(frozen=True)
class SwingParameters:
    """Swing foot trajectory, and detection of touchdown."""

    height_m: float = _length(0.055, 'How high the swing foot is lifted.')
    early_arrival: float = _share(
        0.94, 'Share of the swing at which the foot is above its landing.'
    )
    reach_down_m_s: float = _speed(0.2, 'Downward velocity when touchdown is late.')
    deepest_m: float = _length(0.06, 'How far below the expected ground the foot reaches.')
    longest_tick_s: float = _time(
        0.04,
        'Gap between two control periods after which the swing continues from the actual foot.',
    )
    touchdown_phase: float = _share(
        0.5, 'Share of the swing after which a foot that meets something stays there.'
    )
    touchdown_load: float = _share(
        0.12, 'Share of the weight that the foot must carry to stay there.'
    )
    touch_load: float = _share(
        0.06, 'Share of the weight that is enough for that near the end of the swing.'
    )
    lost_load: float = _share(
        0.03, 'Share of the weight below which a landed foot has lost the ground.'
    )
    lost_s: float = _time(
        0.025, 'Time for which the load must be that small before the foot swings on.'
    )
    least_s: float = _time(
        0.08, 'Time left in the swing below which such a foot goes straight down.'
    )
    gentle_phase: float = _share(
        0.75, 'Share of the swing after which the smaller load is enough.'
    )
    landing_phase: float = _share(
        0.85, 'Share of the swing after which a landed foot may take the weight.'
    )
    late_touchdown_s: float = _time(
        0.16, 'How late a landing may be before the step ends without it.'
    )


@dataclass(frozen=True)
class TerrainParameters:
    """Adaptation of feet and pelvis to ground that is not level."""

    adapt_early_1_s: float = _rate(
        25.0, 'Rate at which a loaded sole adapts to the tilt of the ground at first.'
    )
    adapt_early_s: float = _time(0.15, 'Time after the landing in which it adapts at that rate.')
    adapt_1_s: float = _rate(10.0, 'Rate at which it adapts later.')
    adapt_load: float = _share(
        0.4, 'Share of the weight at which a sole adapts fully; with less it is stiffer.'
    )
    adapt_height_1_s: float = _rate(
        10.0, 'Rate at which a foot without load adapts to the height of the ground.'
    )
    press_m_s: float = _speed(
        0.1, 'Velocity at which a foot that only touches the ground is pressed down.'
    )
    most_tilt_rad: float = _fixed(0.2, 'Tilt to which measured tilts of the ground are clamped.')
    slope_share: float = _share(
        0.5, 'Share of the tilt under a foot that is expected of the ground ahead.'
    )
    level_rate_1_s: float = _rate(
        6.0, 'Rate at which the height of the pelvis follows that of the feet.'
    )
    level_leak_1_s: float = _rate(
        8.0, 'Rate at which its reference returns to the measured height.'
    )
    level_distance_m: float = _length(
        0.04, 'Maximum distance of that reference from the measured height.'
    )
    level_tolerance_m: float = _length(
        0.005, 'Difference in height below which footholds count as one level floor for odometry.'
    )


@dataclass(frozen=True)
class FallParameters:
    """Fall detection, compliant fall, and standing up."""

    tilt_rad: float = _fixed(0.6, 'Tilt beyond which the robot counts as falling.')
    foresight_s: float = _time(0.2, 'How far ahead the tilt is predicted, to detect a fall.')
    height: float = _share(
        0.7, 'Share of its standing height below which the base counts as falling.'
    )
    upright_tilt_rad: float = _fixed(
        0.3, 'Tilt below which a robot above its legs counts as held and can stand up.'
    )
    collapse_s: float = _time(1.5, 'Time for which joints stay compliant before they are limp.')
    collapse_stiffness: float = _share(0.15, 'Share of the stiffness of the joints meanwhile.')
    get_up: bool = parameter(
        True, 'Whether the robot gets up from the ground by itself.', read_only=True
    )
    lie_s: float = _time(2.0, 'Time for which the robot lies limp before it gets up.')
    get_up_tries: int = parameter(
        3,
        'How often it tries to get up before it gives up and stays limp.',
        at_least=1,
        at_most=20,
        read_only=True,
    )
    get_up_unit_s: float = _time(
        1.0, 'Unit of time of the motions of getting up; more makes them slower.'
    )
    stand_up_s: float = _time(1.5, 'Time in which the joints reach the standing posture.')
    standing_load: float = _share(
        0.6, 'Share of the weight on the soles at which the robot walks again.'
    )


@dataclass(frozen=True)
class ObstacleParameters:
    """Detection of obstacles by contact, and retreat from them."""

    force_rate_1_s: float = _rate(8.0, 'Bandwidth of the estimate of external forces.')
    bump_ns: float = _growing(
        3.5, 12.0, 'Impulse against the motion above which the way counts as blocked.'
    )
    bump_memory_s: float = _time(0.8, 'Time constant with which impulses are forgotten.')
    turn_back_m_s: float = _speed(
        0.8, 'Velocity at which the swing foot moves to its new landing.'
    )
    keep_off_m: float = _length(
        0.01, 'Distance that the feet keep from where a foot has met something.'
    )
    keep_off_slope: float = _share(
        0.15, 'How much that distance shrinks per lateral distance: its direction is uncertain.'
    )
    touch_rate_1_s: float = _rate(16.0, 'Bandwidth of the contact estimate of the limbs.')
    touch_load_rate_1_s: float = _rate(
        1.5, 'Rate at which the load on an arm of a standing robot becomes its payload.'
    )
    touch_gap_s: float = _time(
        0.025, 'Gap between two observations beyond which touch is not estimated.'
    )
    leg_touch_nm: float = _growing(
        4.0,
        16.0,
        'Hip moment along x, against the motion, at which a swing leg has met something.',
    )
    leg_touch_aside_nm: float = _growing(4.0, 10.0, 'The same along y, where a step needs less.')
    leg_touch_from_phase: float = _share(
        0.1, 'Share of the swing after which the leg can meet something.'
    )
    arm_touch_nm: float = _growing(4.0, 4.0, 'Shoulder moment at which an arm has met something.')
    retreat_m_s: float = _speed(0.12, 'Velocity at which the robot steps back.')
    retreat_m: float = _length(0.12, 'How far it steps back.')
    retreat_s: float = _time(4.0, 'Maximum time for which it steps back.')
    lean_m: float = _length(
        0.03, 'Offset of the DCM towards the obstacle beyond which it does not step back yet.'
    )
    let_go_s: float = _time(
        0.5, 'Time without a command in that direction before it may be tried again.'
    )
    forget_m: float = _length(0.5, 'Distance beyond which an obstacle is forgotten.')


@dataclass(frozen=True)
class JointParameters:
    """Limits of the joint velocities and accelerations that the walk commands."""

    velocity_limit_rad_s: float = _rate(12.0, 'Maximum joint velocity.')
    acceleration_limit_rad_s2: float = _growing(-1.0, 250.0, 'Maximum joint acceleration.')


@dataclass(frozen=True)
class WalkParameters:
    """
    Gait parameters of the robot at scale 1; `scaled` returns those of another size.

    A robot of scale s is dynamically similar: times scale with sqrt(s), lengths with s, velocities
    with sqrt(s) (Froude's law; see humanoid_description/config/scaling.yaml for details).
    """

    timing: TimingParameters = TimingParameters()
    footsteps: FootstepParameters = FootstepParameters()
    velocity: VelocityParameters = VelocityParameters()
    posture: PostureParameters = PostureParameters()
    body_pose: BodyPoseParameters = BodyPoseParameters()
    balance: BalanceParameters = BalanceParameters()
    step_adjustment: StepAdjustmentParameters = StepAdjustmentParameters()
    swing: SwingParameters = SwingParameters()
    terrain: TerrainParameters = TerrainParameters()
    fall: FallParameters = FallParameters()
    obstacles: ObstacleParameters = ObstacleParameters()
    joints: JointParameters = JointParameters()

    def scaled(self, scale: float) -> WalkParameters:
        """
        Scale the gait parameters to a robot of another size (Froude similarity).

        Parameters
        ----------
        scale
            Size of that robot, relative to the one of these parameters.

        Returns
        -------
        WalkParameters
            Gait parameters of that robot; these are not modified.

        Raises
        ------
        WalkingError
            The scale is not positive and finite.

        """
        if not (0.0 < scale < float('inf')):
            raise WalkingError(f'The scale {scale:g} is not a size. Give one as 0.65.')
        grown: WalkParameters = _grown(self, scale)
        return grown


def _grown(values: Any, scale: float) -> Any:
    """Scale the fields of a dataclass by their powers of the size, including nested groups."""
    changed = {}
    for entry in fields(values):
        value = getattr(values, entry.name)
        if is_dataclass(value):
            changed[entry.name] = _grown(value, scale)
        elif _POWER in entry.metadata:
            changed[entry.name] = value * scale ** entry.metadata[_POWER]
    return replace(values, **changed)
