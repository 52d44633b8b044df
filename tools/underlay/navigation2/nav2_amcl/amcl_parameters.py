# SPDX-License-Identifier: Apache-2.0
"""The parameters of AMCL, and their conversion to the settings of the localizer."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_amcl.laser_models import BeamSkipping, LASER_MODELS, LaserNoise
from nav2_amcl.localizer import LocalizerSettings
from nav2_amcl.motion_models import MOTION_MODELS, MotionNoise
from nav2_amcl.particle_filter import FilterOptions
from nav2_util.parameters import parameter

__all__ = ['AmclParameters', 'settings_of']

_FREE_CELL_STEP = 4
_BEAM_GLOBAL_FACTOR = 2


@dataclass(frozen=True)
class AmclParameters:
    """The parameters of `amcl`."""

    alpha1: float = parameter(0.2, 'Noise of the rotation of odometry by rotation.', low=0.0)
    alpha2: float = parameter(0.2, 'Noise of the rotation of odometry by translation.', low=0.0)
    alpha3: float = parameter(0.2, 'Noise of the translation of odometry by translation.', low=0.0)
    alpha4: float = parameter(0.2, 'Noise of the translation of odometry by rotation.', low=0.0)
    alpha5: float = parameter(0.2, 'Noise across the translation (omni model only).', low=0.0)
    always_reset_initial_pose: bool = parameter(
        False, 'Start from the initial pose at each activation, and not from the last known pose.'
    )
    base_frame_id: str = parameter('base_footprint', 'The frame of the robot.')
    beam_skip_distance: float = parameter(
        0.5,
        'How far the end of a beam may be from an obstacle to agree with the map (m).',
        low=0.0,
    )
    beam_skip_error_threshold: float = parameter(
        0.9, 'If more than this share of beams would be skipped, none is.', low=0.0, high=1.0
    )
    beam_skip_threshold: float = parameter(
        0.3, 'Beams with which less than this share of particles agrees are skipped.', low=0.0
    )
    do_beamskip: bool = parameter(False, 'Skip beams (likelihood_field_prob only).')
    first_map_only: bool = parameter(False, 'Use the first map only, and no later one.')
    freespace_downsampling: bool = parameter(
        False, 'Start anywhere in each fourth free cell only (large maps).'
    )
    global_frame_id: str = parameter('map', 'The frame of the map.')
    initial_pose_x: float = parameter(0.0, 'Where the robot starts (m).', name='initial_pose.x')
    initial_pose_y: float = parameter(0.0, 'Where the robot starts (m).', name='initial_pose.y')
    initial_pose_z: float = parameter(0.0, 'Not used: in the plane.', name='initial_pose.z')
    initial_pose_yaw: float = parameter(
        0.0, 'The heading with which the robot starts (rad).', name='initial_pose.yaw'
    )
    lambda_short: float = parameter(0.1, 'Decay of z_short with distance (1/m).', low=0.0)
    laser_likelihood_max_dist: float = parameter(
        2.0, 'The largest distance from an obstacle that counts (m).', low=0.0
    )
    laser_max_range: float = parameter(
        100.0, "The longest reading that counts as a hit (m); -1 for the scanner's maximum."
    )
    laser_min_range: float = parameter(
        -1.0, "The shortest reading that counts (m); -1 for the scanner's minimum."
    )
    laser_model_type: str = parameter(
        'likelihood_field', 'How scans are compared with the map.', choices=LASER_MODELS
    )
    map_topic: str = parameter('map', 'The topic of the map.')
    max_beams: int = parameter(60, 'How many beams of a scan are used.', low=2, high=100_000)
    max_particles: int = parameter(2000, 'The most particles.', low=1, high=1_000_000)
    min_particles: int = parameter(500, 'The fewest particles.', low=1, high=1_000_000)
    odom_frame_id: str = parameter('odom', 'The frame of odometry.')
    pf_err: float = parameter(
        0.05, 'The largest error of the distribution (Kullback-Leibler distance).', low=1e-6
    )
    pf_z: float = parameter(
        0.99, 'The probability that the error is not larger.', low=0.01, high=0.999999
    )
    random_seed: int = parameter(-1, 'The seed of randomness; below 0: another one each time.')
    recovery_alpha_fast: float = parameter(
        0.0, 'Decay of the fast average of weights; 0 turns recovery off.', low=0.0, high=1.0
    )
    recovery_alpha_slow: float = parameter(
        0.0, 'Decay of the slow average of weights; 0 turns recovery off.', low=0.0, high=1.0
    )
    resample_interval: int = parameter(
        1, 'After how many updates particles are drawn anew.', low=1, high=1_000_000
    )
    robot_model_type: str = parameter(
        'nav2_amcl::DifferentialMotionModel', 'How the robot moves.', choices=tuple(MOTION_MODELS)
    )
    save_pose_rate: float = parameter(
        0.5, 'How often the pose is kept for the next activation (Hz); 0 for never.'
    )
    scan_topic: str = parameter('scan', 'The topic of laser scans.')
    set_initial_pose: bool = parameter(False, 'Start at initial_pose.')
    sigma_hit: float = parameter(0.2, 'Standard deviation of readings that hit (m).', low=1e-3)
    tf_broadcast: bool = parameter(True, 'Publish the transform from the map to odometry.')
    transform_tolerance: float = parameter(
        1.0, 'How long a published transform is valid beyond the time of its scan (s).', low=0.0
    )
    update_min_a: float = parameter(0.2, 'Rotation before an update (rad).', low=0.0)
    update_min_d: float = parameter(0.25, 'Translation before an update (m).', low=0.0)
    z_hit: float = parameter(0.5, 'Weight of readings of what the map shows.', low=0.0)
    z_max: float = parameter(0.05, 'Weight of readings without return (beam model).', low=0.0)
    z_rand: float = parameter(0.5, 'Weight of readings of anything.', low=0.0)
    z_short: float = parameter(0.05, 'Weight of readings of what stands in front.', low=0.0)


def settings_of(values: AmclParameters) -> LocalizerSettings:
    """
    Convert the parameters of the node to the settings of the localizer.

    Parameters
    ----------
    values
        The parameters.

    Raises
    ------
    ValueError
        `min_particles` is larger than `max_particles`; the text is the end of a sentence.

    """
    if values.min_particles > values.max_particles:
        raise ValueError(
            f'min_particles is {values.min_particles} and larger than max_particles, '
            f'which is {values.max_particles}'
        )
    skipping = BeamSkipping(
        values.beam_skip_distance, values.beam_skip_threshold, values.beam_skip_error_threshold
    )
    return LocalizerSettings(
        filter_options=FilterOptions(
            min_particles=values.min_particles,
            max_particles=values.max_particles,
            kld_error=values.pf_err,
            kld_quantile=values.pf_z,
            alpha_slow=values.recovery_alpha_slow,
            alpha_fast=values.recovery_alpha_fast,
            free_cell_step=_FREE_CELL_STEP if values.freespace_downsampling else 1,
            global_factor=_BEAM_GLOBAL_FACTOR if values.laser_model_type == 'beam' else 10,
        ),
        motion_noise=MotionNoise(
            values.alpha1, values.alpha2, values.alpha3, values.alpha4, values.alpha5
        ),
        laser_noise=LaserNoise(
            z_hit=values.z_hit,
            z_short=values.z_short,
            z_max=values.z_max,
            z_rand=values.z_rand,
            sigma_hit_m=values.sigma_hit,
            lambda_short=values.lambda_short,
            max_distance_m=values.laser_likelihood_max_dist,
        ),
        skipping=skipping if values.do_beamskip else None,
        motion_model=values.robot_model_type,
        laser_model=values.laser_model_type,
        max_beams=values.max_beams,
        min_range_m=values.laser_min_range,
        max_range_m=values.laser_max_range,
        update_min_distance_m=values.update_min_d,
        update_min_angle_rad=values.update_min_a,
        resample_interval=values.resample_interval,
    )
