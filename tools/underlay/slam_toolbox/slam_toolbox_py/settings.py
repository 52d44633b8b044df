# SPDX-License-Identifier: Apache-2.0
"""The settings of a mapper, named as the parameters of slam_toolbox."""

from __future__ import annotations

from dataclasses import dataclass

from slam_toolbox_py.matching import CorrelationSettings

__all__ = ['MapperSettings']

_GRID_M = 0.05


@dataclass(frozen=True)
class MapperSettings:
    """Settings of scan matching and loop closing, in m, rad and s."""

    use_scan_matching: bool = True
    use_scan_barycenter: bool = True
    minimum_travel_distance: float = 0.5
    minimum_travel_heading: float = 0.5
    scan_buffer_size: int = 10
    scan_buffer_maximum_scan_distance: float = 10.0
    link_match_minimum_response_fine: float = 0.1
    do_loop_closing: bool = True
    loop_search_maximum_distance: float = 3.0
    loop_match_minimum_chain_size: int = 10
    loop_match_maximum_variance_coarse: float = 3.0
    loop_match_minimum_response_coarse: float = 0.35
    loop_match_minimum_response_fine: float = 0.45
    correlation_search_space_dimension: float = 0.5
    correlation_search_space_resolution: float = 0.01
    correlation_search_space_smear_deviation: float = 0.1
    loop_search_space_dimension: float = 8.0
    loop_search_space_resolution: float = 0.05
    loop_search_space_smear_deviation: float = 0.03
    distance_variance_penalty: float = 0.5
    angle_variance_penalty: float = 1.0
    coarse_search_angle_offset: float = 0.349
    coarse_angle_resolution: float = 0.0349
    minimum_angle_penalty: float = 0.9
    minimum_distance_penalty: float = 0.5

    def local_search(self) -> CorrelationSettings:
        """Return the search settings for the next scan, near the pose predicted by odometry."""
        return self._search(
            0.5 * self.correlation_search_space_dimension,
            max(self.correlation_search_space_resolution, _GRID_M),
            self.correlation_search_space_smear_deviation,
        )

    def loop_search(self, half_window_m: float) -> CorrelationSettings:
        """
        Derive the settings of the search for a loop closure.

        Parameters
        ----------
        half_window_m
            The half-width of the search window along x and y, in m; at most half of
            `loop_search_space_dimension`.

        """
        return self._search(
            min(half_window_m, 0.5 * self.loop_search_space_dimension),
            self.loop_search_space_resolution,
            max(self.loop_search_space_smear_deviation, self.loop_search_space_resolution),
        )

    def _search(self, half_m: float, resolution_m: float, smear_m: float) -> CorrelationSettings:
        return CorrelationSettings(
            half_m,
            self.coarse_search_angle_offset,
            resolution_m,
            self.coarse_angle_resolution,
            max(smear_m, 0.5 * resolution_m),
            self.distance_variance_penalty,
            self.angle_variance_penalty,
            self.minimum_distance_penalty,
            self.minimum_angle_penalty,
        )
