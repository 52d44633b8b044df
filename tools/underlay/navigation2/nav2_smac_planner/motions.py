# SPDX-License-Identifier: Apache-2.0
"""Motions of a car from one heading to the next, and the options of their search."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import NamedTuple

from nav2_smac_planner.curves import sample_curve, Segment
from nav2_util.geometry import Pose2D

__all__ = ['CHECK_CELLS', 'HybridOptions', 'Motion', 'Motions']

CHECK_CELLS = 1.4
"""How far apart places are at which a collision is looked for."""


@dataclass(frozen=True)
class HybridOptions:
    """
    Options of a search.

    Attributes
    ----------
    radius_m
        The turning radius.
    headings
        The number of headings.
    can_reverse, allow_unknown
        Whether the car may drive backward, and into unknown space.
    tolerance_m
        The distance from a goal that cannot be reached at which a path may end.
    max_iterations, max_time_s
        The limits; 0 for none.
    max_approach_iterations
        The limit after a pose within the tolerance was reached.
    cost_penalty, cost_power
        As `traversal` and `power` of `weight_table`.
    reverse_penalty, change_penalty, non_straight_penalty
        Factors of a metre backward and in a curve, and what is added to the latter when the
        steering changes sides.
    retrospective_penalty
        The share by which each step is cheaper, so that fewer poses near the start are looked at.
    expansion_ratio
        How often a curve to the goal is tried: more often the nearer the goal is.
    expansion_max_length_m, expansion_max_cost
        The limits of such a curve.
    expand_at_any_cost
        Whether that limit of the cost does not hold very near the goal.

    """

    radius_m: float
    headings: int
    can_reverse: bool
    allow_unknown: bool
    tolerance_m: float
    max_iterations: int
    max_approach_iterations: int
    max_time_s: float
    cost_penalty: float
    cost_power: float
    reverse_penalty: float
    change_penalty: float
    non_straight_penalty: float
    retrospective_penalty: float
    expansion_ratio: float
    expansion_max_length_m: float
    expansion_max_cost: float
    expand_at_any_cost: bool

    @property
    def turn_rad(self) -> float:
        """The angle between neighbouring headings."""
        return 2.0 * math.pi / self.headings


class Motion(NamedTuple):
    """A motion from a heading: its places on the way and at its end, in cells."""

    segment: Segment
    factor: float
    on_the_way: tuple[tuple[float, float, int], ...]
    x: float
    y: float
    heading: int


class Motions:
    """
    Motions of a car, made when they are first asked for.

    Parameters
    ----------
    options
        The options of the search.
    cell_m
        The size of a cell.

    """

    def __init__(self, options: HybridOptions, cell_m: float) -> None:
        self._options, self._cell_m = options, cell_m
        self._known: dict[int, list[Motion]] = {}

    def leaving(self, heading: int) -> list[Motion]:
        """
        Return the motions from a heading: straight on, and in curves; also backward.

        Parameters
        ----------
        heading
            The number of the heading.

        """
        known = self._known.get(heading)
        if known is None:
            options = self._options
            directions = (1.0, -1.0) if options.can_reverse else (1.0,)
            known = self._known[heading] = [
                self._made(heading, steer, direction)
                for direction in directions
                for steer in (0, 1, -1)
            ]
        return known

    def _made(self, heading: int, steer: int, direction: float) -> Motion:
        """Make a motion that leaves the cell, and turns by whole headings."""
        options, cell_m = self._options, self._cell_m
        least_m = math.sqrt(2.0) * cell_m
        share = min(1.0, least_m / (2.0 * options.radius_m))
        turns = max(1, math.ceil(2.0 * math.asin(share) / options.turn_rad - 1e-9))
        length_m = max(least_m, options.radius_m * turns * options.turn_rad)
        start = Pose2D(0.0, 0.0, heading * options.turn_rad)
        segment = Segment(steer, direction * length_m)
        poses = sample_curve(start, [segment], options.radius_m, CHECK_CELLS * cell_m)
        places = [
            (x / cell_m, y / cell_m, round(yaw / options.turn_rad) % options.headings)
            for x, y, yaw in poses.tolist()
        ]
        return Motion(segment, self.factor(segment), tuple(places[:-1]), *places[-1])

    def factor(self, segment: Segment) -> float:
        """
        Return how much a metre of a motion costs in free space.

        Parameters
        ----------
        segment
            The motion: its direction, and whether it is straight.

        """
        options = self._options
        factor = options.non_straight_penalty if segment.steer else 1.0
        return factor * options.reverse_penalty if segment.length_m < 0.0 else factor
