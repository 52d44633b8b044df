# SPDX-License-Identifier: Apache-2.0
"""Gait parameters of the response to pushes, uneven ground, obstacles and falls."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter, ParameterError
from humanoid_description.similarity import (
    angular_damping,
    duration,
    fixed,
    impulse,
    length,
    moment,
    rate,
    share,
    speed,
)


@dataclass(frozen=True)
class BalanceParameters:
    """Feedback control of the divergent component of motion (DCM) and of the attitude."""

    dcm_gain: float = fixed(1.6, 'How far the ZMP moves, as a multiple of the DCM error.')
    observer_rate_1_s: float = rate(60.0, 'Bandwidth of the estimate of the centre of mass.')
    reference_leak_1_s: float = rate(
        8.0, 'Rate at which the reference of the centre of mass returns to the estimate.'
    )
    reference_distance_m: float = length(
        0.04, 'Maximum distance along each axis of that reference from the estimate.'
    )
    attitude_stiffness_nm_rad: float = moment(400.0, 'Stiffness of the attitude of the trunk.')
    attitude_damping_nms_rad: float = angular_damping(
        25.0, 'Damping of the attitude of the trunk.'
    )
    ground_turn_nm: float = moment(15.0, 'Maximum yaw torque of the feet on the ground.')
    heading_share: float = share(
        0.5, 'Share of stiffness and damping that acts on heading errors.'
    )
    push_forward_m: float = length(
        0.065, 'Distance of the DCM ahead of the middle at which a standing robot steps.'
    )
    push_left_m: float = length(
        0.085, 'Distance of the DCM beside the middle at which a standing robot steps.'
    )
    stop_error_m: float = length(0.04, 'DCM error below which the robot may stop.')


@dataclass(frozen=True)
class StepAdjustmentParameters:
    """Adjustment of the position and the timing of a landing to catch the robot."""

    until_s: float = duration(0.06, 'Time before a landing from which its position is fixed.')
    dead_band_m: float = length(0.005, 'Adjustment below which the position is kept.')
    hurry_error_m: float = length(0.06, 'DCM error above which a step may be sped up.')
    hurry_rates: tuple[float, ...] = parameter(
        (1.0, 1.3, 1.6, 2.0),
        'Speed-up factors of a step, slowest first.',
        at_least=1.0,
        at_most=3.0,
        read_only=True,
    )
    unreachable_length_m: float = length(
        0.02, 'How much of the length of a step may be cut before it is sped up instead.'
    )
    unreachable_width_m: float = length(
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
class TerrainParameters:
    """Adaptation of feet and pelvis to ground that is not level."""

    adapt_early_1_s: float = rate(
        25.0, 'Rate at which a loaded sole adapts to the tilt of the ground at first.'
    )
    adapt_early_s: float = duration(
        0.15, 'Time after the landing in which it adapts at that rate.'
    )
    adapt_1_s: float = rate(10.0, 'Rate at which it adapts later.')
    adapt_load: float = share(
        0.4, 'Share of the weight at which a sole adapts fully; with less it is stiffer.'
    )
    adapt_height_1_s: float = rate(
        10.0, 'Rate at which a foot without load adapts to the height of the ground.'
    )
    press_m_s: float = speed(
        0.1, 'Velocity at which a foot that only touches the ground is pressed down.'
    )
    most_tilt_rad: float = fixed(0.2, 'Tilt to which measured tilts of the ground are clamped.')
    slope_share: float = share(
        0.5, 'Share of the tilt under a foot that is expected of the ground ahead.'
    )
    level_rate_1_s: float = rate(
        6.0, 'Rate at which the height of the pelvis follows that of the feet.'
    )
    level_leak_1_s: float = rate(
        8.0, 'Rate at which its reference returns to the measured height.'
    )
    level_distance_m: float = length(
        0.04, 'Maximum distance of that reference from the measured height.'
    )
    level_tolerance_m: float = length(
        0.005, 'Difference in height below which footholds count as one level floor for odometry.'
    )


@dataclass(frozen=True)
class FallParameters:
    """Fall detection, compliant fall, and standing up."""

    tilt_rad: float = fixed(0.6, 'Tilt beyond which the robot counts as falling.')
    foresight_s: float = duration(0.2, 'How far ahead the tilt is predicted, to detect a fall.')
    height: float = share(
        0.7, 'Share of its standing height below which the base counts as falling.'
    )
    upright_tilt_rad: float = fixed(
        0.3, 'Tilt below which a robot above its legs counts as held and can stand up.'
    )
    collapse_s: float = duration(1.5, 'Time for which joints stay compliant before they are limp.')
    collapse_stiffness: float = share(0.15, 'Share of the stiffness of the joints meanwhile.')
    get_up: bool = parameter(
        True, 'Whether the robot gets up from the ground by itself.', read_only=True
    )
    lie_s: float = duration(2.0, 'Time for which the robot lies limp before it gets up.')
    get_up_tries: int = parameter(
        3,
        'How often it tries to get up before it gives up and stays limp.',
        at_least=1,
        at_most=20,
        read_only=True,
    )
    get_up_unit_s: float = duration(
        1.0, 'Unit of time of the motions of getting up; more makes them slower.'
    )
    stand_up_s: float = duration(1.5, 'Time in which the joints reach the standing posture.')
    standing_load: float = share(
        0.6, 'Share of the weight on the soles at which the robot walks again.'
    )


@dataclass(frozen=True)
class ObstacleParameters:
    """Detection of obstacles by contact, and retreat from them."""

    force_rate_1_s: float = rate(8.0, 'Bandwidth of the estimate of external forces.')
    bump_ns: float = impulse(
        12.0, 'Impulse against the motion above which the way counts as blocked.'
    )
    bump_memory_s: float = duration(0.8, 'Time constant with which impulses are forgotten.')
    turn_back_m_s: float = speed(0.8, 'Velocity at which the swing foot moves to its new landing.')
    keep_off_m: float = length(
        0.01, 'Distance that the feet keep from where a foot has met something.'
    )
    keep_off_slope: float = share(
        0.15, 'How much that distance shrinks per lateral distance: its direction is uncertain.'
    )
    touch_rate_1_s: float = rate(16.0, 'Bandwidth of the contact estimate of the limbs.')
    touch_load_rate_1_s: float = rate(
        1.5, 'Rate at which the load on an arm of a standing robot becomes its payload.'
    )
    touch_gap_s: float = duration(
        0.025, 'Gap between two observations beyond which touch is not estimated.'
    )
    leg_touch_nm: float = moment(
        16.0,
        'Hip moment along x, against the motion, at which a swing leg has met something.',
    )
    leg_touch_aside_nm: float = moment(10.0, 'The same along y, where a step needs less.')
    leg_touch_from_phase: float = share(
        0.1, 'Share of the swing after which the leg can meet something.'
    )
    arm_touch_nm: float = moment(4.0, 'Shoulder moment at which an arm has met something.')
    retreat_m_s: float = speed(0.12, 'Velocity at which the robot steps back.')
    retreat_m: float = length(0.12, 'How far it steps back.')
    retreat_s: float = duration(4.0, 'Maximum time for which it steps back.')
    lean_m: float = length(
        0.03, 'Offset of the DCM towards the obstacle beyond which it does not step back yet.'
    )
    let_go_s: float = duration(
        0.5, 'Time without a command in that direction before it may be tried again.'
    )
    forget_m: float = length(0.5, 'Distance beyond which an obstacle is forgotten.')
