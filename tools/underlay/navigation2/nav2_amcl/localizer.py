# SPDX-License-Identifier: Apache-2.0
"""The localizer: when odometry and scans update the particles, and `map` to `odom`."""

from __future__ import annotations

from dataclasses import dataclass, field

from nav2_amcl.clusters import Cluster
from nav2_amcl.laser_models import BeamSkipping, LaserModel, LaserNoise, make_laser_model
from nav2_amcl.motion_models import MOTION_MODELS, MotionNoise
from nav2_amcl.occupancy_map import FloatArray, OccupancyMap
from nav2_amcl.particle_filter import FilterOptions, ParticleFilter
from nav2_amcl.scan_projection import project_scan, Scan
from nav2_util.geometry import angle_between, Pose2D
import numpy as np

__all__ = ['DEFAULT_COVARIANCE', 'Localizer', 'LocalizerSettings']

DEFAULT_COVARIANCE = np.diag([0.25, 0.25, 0.0685])
"""The default covariance of an initial pose: 0.5 m and 15°, squared."""


@dataclass(frozen=True)
class LocalizerSettings:
    """Settings of the localizer; lengths in m, angles in rad."""

    filter_options: FilterOptions = field(default_factory=FilterOptions)
    motion_noise: MotionNoise = field(default_factory=MotionNoise)
    laser_noise: LaserNoise = field(default_factory=LaserNoise)
    skipping: BeamSkipping | None = None
    motion_model: str = 'nav2_amcl::DifferentialMotionModel'
    laser_model: str = 'likelihood_field'
    max_beams: int = 60
    min_range_m: float = -1.0
    max_range_m: float = 100.0
    update_min_distance_m: float = 0.25
    update_min_angle_rad: float = 0.2
    resample_interval: int = 1


class Localizer:
    """
    Localizer of a robot in a map, independent of ROS.

    Parameters
    ----------
    settings
        The settings; may be replaced by `use`.
    random
        The random number generator.

    """

    def __init__(self, settings: LocalizerSettings, random: np.random.Generator) -> None:
        self.filter = ParticleFilter(settings.filter_options, random)
        self.grid: OccupancyMap | None = None
        self.estimate: Cluster | None = None
        """The robot in the map at the last update; None if there was none since the start."""
        self.map_to_odom: Pose2D | None = None
        """The frame of odometry in the map, once it is known."""
        self._settings = settings
        self._model: LaserModel | None = None
        self._started = False
        self._goes_anywhere = False
        self._is_forced = False
        self._odom: Pose2D | None = None
        self._updates = 0

    @property
    def is_started(self) -> bool:
        """Whether an initial pose, or a global initialisation, was given."""
        return self._started or self._goes_anywhere

    def use(self, settings: LocalizerSettings) -> None:
        """
        Replace the settings; the particles are kept.

        Parameters
        ----------
        settings
            The settings, used from the next scan on.

        """
        if settings != self._settings:
            self._settings, self.filter.options = settings, settings.filter_options
            self._model = None

    def set_map(self, grid: OccupancyMap) -> None:
        """
        Replace the map; the particles are kept, and the next scan updates them.

        Parameters
        ----------
        grid
            The map in which the robot is localised.

        """
        self.grid, self._model = grid, None
        self._is_forced = True

    def start_at(self, pose: Pose2D, covariance: FloatArray | None = None) -> None:
        """
        Initialise the particles at a pose in the map.

        Parameters
        ----------
        pose
            The pose of the robot.
        covariance
            The (3, 3) matrix of x, y (m) and yaw (rad). None, or all zeros as from a client that
            omits it, means `DEFAULT_COVARIANCE`.

        """
        if covariance is None or not covariance.any():
            covariance = DEFAULT_COVARIANCE
        self.filter.start_at(pose, covariance)
        self._started, self._goes_anywhere = True, False
        self.forget_odometry()

    def start_anywhere(self) -> None:
        """Initialise the particles in the free space of the map, now or when it is received."""
        self._goes_anywhere = True
        self.forget_odometry()

    def force_update(self) -> None:
        """Force an update with the next scan, even if the robot does not move."""
        self._is_forced = True

    def forget_odometry(self) -> None:
        """Restart odometry: match its next pose to the current particles, and force an update."""
        self._odom, self._is_forced = None, True
        self.map_to_odom = self.estimate = None

    def observe(
        self, scan: Scan, rotation: FloatArray, translation: FloatArray, odom: Pose2D
    ) -> bool:
        """
        Process a scan.

        Parameters
        ----------
        scan
            The readings.
        rotation, translation
            (3, 3) matrix and (3,) vector in m of the laser in the frame of odometry.
        odom
            The base in the frame of odometry.

        Returns
        -------
        Whether the particles were updated: after sufficient motion, when forced, or at the start.

        """
        grid = self.grid
        if grid is None or not self.is_started:
            return False
        if self._goes_anywhere:
            self.filter.start_anywhere(grid)
            self._started, self._goes_anywhere = True, False
        if not (self._is_forced or self._has_moved(odom)):
            return False
        self._update(grid, scan, rotation, translation, odom)
        return True

    def _has_moved(self, odom: Pose2D) -> bool:
        last, settings = self._odom, self._settings
        return (
            last is None
            or last.distance_to(odom) >= settings.update_min_distance_m
            or abs(angle_between(last.yaw, odom.yaw)) >= settings.update_min_angle_rad
        )

    def _update(
        self,
        grid: OccupancyMap,
        scan: Scan,
        rotation: FloatArray,
        translation: FloatArray,
        odom: Pose2D,
    ) -> None:
        settings = self._settings
        if self._model is None:
            self._model = make_laser_model(
                settings.laser_model, grid, settings.laser_noise, settings.skipping
            )
        if self._odom is not None:
            model = MOTION_MODELS[settings.motion_model]
            self.filter.move(model, self._odom, odom, settings.motion_noise)
        self._odom, self._is_forced = odom, False
        beams = project_scan(
            scan,
            *_relative_to(odom, rotation, translation),
            settings.max_beams,
            settings.min_range_m,
            settings.max_range_m,
        )
        self.filter.weigh(self._model, beams)
        self.estimate = self.filter.estimate()
        self.map_to_odom = Pose2D(*self.estimate.pose) @ odom.inverse()
        self._updates += 1
        if self._updates % settings.resample_interval == 0:
            self.filter.resample(grid)


def _relative_to(
    base: Pose2D, rotation: FloatArray, translation: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Transform a rotation and translation to a level frame at the base, with its heading."""
    cos, sin = np.cos(base.yaw), np.sin(base.yaw)
    turn = np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])
    return turn @ rotation, turn @ (translation - np.array([base.x, base.y, 0.0]))
