# SPDX-License-Identifier: Apache-2.0
"""The parameters of MPPI, besides those of its critics."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_util.parameters import parameter, Unsupported

__all__ = ['UNSUPPORTED', 'MppiParameters']

UNSUPPORTED = {
    'publish_optimal_trajectory': Unsupported(
        "the best trajectory is published on 'local_plan'", (False,)
    ),
    'publish_critics_stats': Unsupported('the scores of critics are not published', (False,)),
    'dump_parameters': Unsupported('use ros2 param dump', (False,)),
    'verbose': Unsupported('the log levels of the node hold', (False,)),
    'open_loop': Unsupported('the measured velocity is where trajectories start', (False,)),
}


@dataclass(frozen=True)
class MppiParameters:
    """The parameters of MPPI."""

    motion_model: str = parameter(
        'DiffDrive',
        'How the robot moves: DiffDrive, Omni (sideways, too) or Ackermann (no turns in place).',
        choices=('DiffDrive', 'Omni', 'Ackermann'),
    )
    iteration_count: int = parameter(1, 'Rounds of optimization in each period.', low=1, high=50)
    batch_size: int = parameter(
        1000, 'The number of trajectories. It decides what a period costs.', low=1, high=100000
    )
    time_steps: int = parameter(56, 'The number of steps of a trajectory.', low=2, high=1000)
    model_dt: float = parameter(0.05, 'The duration of a step in s.', low=0.001)
    vx_std: float = parameter(0.2, 'The standard deviation of sampled vx in m/s.', low=0.0)
    vy_std: float = parameter(0.2, 'The standard deviation of sampled vy in m/s.', low=0.0)
    wz_std: float = parameter(0.4, 'The standard deviation of sampled wz in rad/s.', low=0.0)
    vx_max: float = parameter(0.5, 'The highest velocity along x in m/s.')
    vx_min: float = parameter(-0.35, 'The lowest velocity along x in m/s.')
    vy_max: float = parameter(0.5, 'The highest velocity along y in m/s.', low=0.0)
    wz_max: float = parameter(1.9, 'The highest angular velocity in rad/s.', low=0.0)
    ax_max: float = parameter(3.0, 'The acceleration along x in m/s^2.', low=0.0)
    ax_min: float = parameter(-3.0, 'The deceleration along x in m/s^2.', high=0.0)
    ay_max: float = parameter(3.0, 'The acceleration along y in m/s^2.', low=0.0)
    ay_min: float = parameter(-3.0, 'The deceleration along y in m/s^2.', high=0.0)
    az_max: float = parameter(3.5, 'The angular acceleration in rad/s^2.', low=0.0)
    temperature: float = parameter(
        0.3, 'How much the best trajectories outweigh others: less means more.', low=1e-6
    )
    gamma: float = parameter(0.015, 'How much changes of the control cost.', low=0.0)
    visualize: bool = parameter(False, "Whether to publish trajectories on 'trajectories'.")
    trajectory_step: int = parameter(
        5,
        'One in how many trajectories is shown.',
        low=1,
        name='TrajectoryVisualizer.trajectory_step',
    )
    trajectory_time_step: int = parameter(
        3,
        'One in how many points of those is shown.',
        low=1,
        name='TrajectoryVisualizer.time_step',
    )
    retry_attempt_limit: int = parameter(
        1, 'How often to try again from standstill when all trajectories collide.', low=0
    )
    reset_period: float = parameter(
        1.0, 'The time in s without control after which the optimizer starts anew.', low=0.0
    )
    regenerate_noises: bool = parameter(False, 'Whether each period has other noise.')
    prune_distance: float = parameter(
        1.5, 'The length in m of the path ahead that is regarded.', low=0.0
    )
    enforce_path_inversion: bool = parameter(
        False, 'Whether to follow the path to each point where it turns back.'
    )
    inversion_xy_tolerance: float = parameter(
        0.2, 'The distance in m from such a point that is near enough.', low=0.0
    )
    inversion_yaw_tolerance: float = parameter(
        0.4, 'The angle in rad from its orientation that is near enough.', low=0.0
    )
    min_turning_r: float = parameter(
        0.2,
        'The radius in m of the narrowest curve.',
        low=0.0,
        name='AckermannConstraints.min_turning_r',
    )
