# SPDX-License-Identifier: Apache-2.0
"""
The front end of SLAM: keyframes, matched one after the other.

A scan is processed when the robot has moved sufficiently. It is matched to the last keyframes, and
becomes a node of the pose graph, with an edge to the previous one. Loops are closed in
`loop_closure`, in steps, after that.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from slam_toolbox_py.matching import correlate, refine, RefinedMatch, Surfaces
from slam_toolbox_py.pose_graph import Edge, PoseGraph
from slam_toolbox_py.poses import compose, FloatArray, inverse, relative, wrap
from slam_toolbox_py.scans import Scan
from slam_toolbox_py.settings import MapperSettings

__all__ = [
    'Keyframe',
    'Mapper',
    'Placement',
    'find_again',
    'has_moved',
    'placement_of',
    'trust_in_odometry',
]

_REFERENCES = 12
_ANYWHERE = np.diag([1.0, 1.0, 10.0])
_START_WINDOW_M = 1.0


@dataclass(frozen=True)
class Keyframe:
    """A scan that is part of the map."""

    scan: Scan
    odometry: FloatArray
    """(3,) pose of the base in the odometry frame when it was taken."""
    stamp_s: float


@dataclass(frozen=True)
class Placement:
    """The pose at which a scan was taken."""

    pose: FloatArray
    """(3,) pose of the base in the map."""
    covariance: FloatArray
    """(3, 3) covariance of the pose, in the axes of the base, in m2 and rad2."""
    response: float
    """The quality of the match, from 0 to 1."""


def placement_of(match: RefinedMatch) -> Placement:
    """
    Convert a match to the placement of its scan.

    Parameters
    ----------
    match
        Pose and information, in the axes of the base; the covariance is the inverse.

    """
    covariance: FloatArray = np.asarray(np.linalg.inv(match.information), dtype=np.float64)
    return Placement(match.pose, covariance, match.response)


class Mapper:
    """
    Matches scans, and stores them as keyframes of the map.

    Parameters
    ----------
    settings
        The settings of scan matching; may be replaced at any time.

    """

    def __init__(self, settings: MapperSettings | None = None) -> None:
        self.settings = settings or MapperSettings()
        self.graph = PoseGraph()
        self.keyframes: list[Keyframe] = []
        self.travelled_m: list[float] = []
        """The distance travelled by the robot up to each keyframe."""
        self.last_loop = -(10**6)
        """The keyframe that closed the latest loop."""
        self.map_to_odom: FloatArray = np.zeros(3)
        """(3,) pose of the odometry frame in the map."""
        self._starts: list[FloatArray] = []
        self._session = 0
        self._middles: list[FloatArray] = []

    def start_at(self, *poses: FloatArray) -> None:
        """
        Search for the robot near given poses with the next scan, which starts a new session.

        Parameters
        ----------
        *poses
            Poses (3,) of the base in the map.

        """
        self._starts = [np.asarray(pose, dtype=float) for pose in poses]
        self._session = len(self.keyframes)

    @property
    def is_searching(self) -> bool:
        """Whether the next scan is searched for near given poses."""
        return bool(self._starts)

    def is_due(self, odometry: FloatArray, share: float = 1.0) -> bool:
        """
        Whether the robot has moved enough for a new keyframe.

        Parameters
        ----------
        odometry
            (3,) pose of the base in the odometry frame.
        share
            The fraction of the minimum travel that is sufficient.

        """
        if not self.keyframes or self._starts:
            return True
        return has_moved(self.keyframes[-1].odometry, odometry, self.settings, share)

    def add_known(self, keyframe: Keyframe, pose: FloatArray, travelled_m: float) -> None:
        """
        Add a keyframe whose pose is known, without matching it and without an edge.

        Parameters
        ----------
        keyframe
            The scan, with odometry and time.
        pose
            Pose (3,) of the base in the map.
        travelled_m
            The distance that the robot has travelled up to there, in m.

        """
        self.keyframes.append(keyframe)
        self.travelled_m.append(travelled_m)
        self.graph.add_node(pose)

    def add(self, scan: Scan, odometry: FloatArray, stamp_s: float = 0.0) -> Placement:
        """
        Match a scan, and add it as a keyframe.

        Parameters
        ----------
        scan
            The scan.
        odometry
            (3,) pose of the base in the odometry frame at that time.
        stamp_s
            That time.

        """
        origin, way = None, 0.0
        if not self.keyframes:
            start = self._starts[0] if self._starts else np.asarray(odometry, dtype=float)
            match = RefinedMatch(start, np.diag([1e6, 1e6, 1e6]), 1.0)
        elif self._starts:
            match, origin = find_again(self, scan, self._starts)
        else:
            match, origin = self._followed(scan, odometry)
            moved = relative(self.keyframes[-1].odometry, odometry)
            way = float(np.hypot(moved[0], moved[1]))
        self._starts = []
        way += self.travelled_m[-1] if self.keyframes else 0.0
        self.add_known(Keyframe(scan, np.array(odometry, dtype=float), stamp_s), match.pose, way)
        if origin is not None:
            between = relative(self.graph.poses[origin], match.pose)
            node = len(self.keyframes) - 1
            self.graph.add_edge(Edge(origin, node, between, match.information))
        self.follow_graph()
        return placement_of(match)

    def follow_graph(self) -> None:
        """Update `map_to_odom` from the newest keyframe, after the graph has changed."""
        if self.keyframes:
            last = inverse(self.keyframes[-1].odometry)
            self.map_to_odom = compose(self.graph.poses[-1], last)

    def surfaces(self, nodes: list[int]) -> Surfaces:
        """
        Collect the points and normals of the scans of keyframes, in the map.

        Parameters
        ----------
        nodes
            The indices of the keyframes, at their current poses in the graph.

        """
        return Surfaces([(self.keyframes[i].scan, self.graph.poses[i]) for i in nodes])

    def positions(self) -> FloatArray:
        """Return the (N, 2) positions of keyframes by which their distances are measured."""
        if not self.settings.use_scan_barycenter:
            return self.graph.poses[:, :2]
        known = len(self._middles)
        for each in self.keyframes[known:]:
            self._middles.append(np.append(each.scan.barycenter, 0.0))
        return compose(self.graph.poses, np.reshape(self._middles, (-1, 3)))[:, :2]

    def nearest(self, position: FloatArray, count: int = _REFERENCES) -> list[int]:
        """
        Find the keyframes that were taken nearest to a position.

        Parameters
        ----------
        position
            Position (2,) in the map, in m.
        count
            The number of keyframes to find.

        Returns
        -------
        list of int
            Their indices, the nearest first.

        """
        away = np.hypot(*(self.graph.poses[:, :2] - position).T)
        return [int(i) for i in np.argsort(away, kind='stable')[:count]]

    def _followed(self, scan: Scan, odometry: FloatArray) -> tuple[RefinedMatch, int]:
        """Match a scan to the last keyframes, near the pose predicted by odometry."""
        last = len(self.keyframes) - 1
        moved = relative(self.keyframes[-1].odometry, odometry)
        guess = compose(self.graph.poses[-1], moved)
        trust = trust_in_odometry(moved)
        if not self.settings.use_scan_matching:
            return RefinedMatch(guess, trust, 0.0), last
        seen = self.surfaces(self._recent())
        start = correlate(seen.points, scan.points, guess, self.settings.local_search())
        match = refine(seen, scan, start.pose, guess, trust)
        if match.response < self.settings.link_match_minimum_response_fine:
            return RefinedMatch(guess, trust, match.response), last
        return match, last

    def _recent(self) -> list[int]:
        """Return the last keyframes that are sufficiently near the newest one."""
        first = max(self._session, len(self.keyframes) - self.settings.scan_buffer_size)
        recent = np.arange(first, len(self.keyframes))
        away = self.graph.poses[recent, :2] - self.graph.poses[-1, :2]
        is_near = np.hypot(*away.T) <= self.settings.scan_buffer_maximum_scan_distance
        return [int(i) for i in recent[is_near]]


def has_moved(
    before: FloatArray, odometry: FloatArray, settings: MapperSettings, share: float
) -> bool:
    """
    Check whether a robot has moved enough between two poses, by distance or by rotation.

    Parameters
    ----------
    before, odometry
        Earlier and current pose (3,) of the base in the odometry frame.
    settings
        The settings, with the minimum travel and rotation.
    share
        The fraction of these that is sufficient.

    """
    moved = relative(before, odometry)
    return bool(
        np.hypot(moved[0], moved[1]) >= share * settings.minimum_travel_distance
        or abs(moved[2]) >= share * settings.minimum_travel_heading
    )


def find_again(
    mapper: Mapper, scan: Scan, guesses: list[FloatArray], half_window_m: float = _START_WINDOW_M
) -> tuple[RefinedMatch, int]:
    """
    Match a scan to the keyframes near given poses, to relocalize the robot.

    A match that is not good enough is replaced by the first guess, with little information.

    Parameters
    ----------
    mapper
        The keyframes and the settings of the matching.
    scan
        The scan.
    guesses
        Poses (3,) of the base in the map.
    half_window_m
        The half-width of the search window around each guess along x and y, in m.

    Returns
    -------
    tuple of RefinedMatch and int
        The best match, and the index of the keyframe nearest to its guess.

    """
    search, found = mapper.settings.loop_search(half_window_m), []
    for guess in guesses:
        near = mapper.nearest(guess[:2])
        seen = mapper.surfaces(near)
        start = correlate(seen.points, scan.points, guess, search)
        found.append((refine(seen, scan, start.pose, start.pose, _ANYWHERE), near[0]))
    match, origin = max(found, key=lambda each: each[0].response)
    if match.response >= mapper.settings.loop_match_minimum_response_fine:
        return match, origin
    near = mapper.nearest(guesses[0][:2])
    return RefinedMatch(guesses[0], _ANYWHERE, match.response), near[0]


def trust_in_odometry(moved: FloatArray) -> FloatArray:
    """
    Compute the information matrix of a motion measured by odometry.

    Parameters
    ----------
    moved
        The motion (3,) in the axes of the base at its start: x and y in m, yaw in rad.

    Returns
    -------
    FloatArray
        Diagonal information matrix (3, 3), in 1/m2 and 1/rad2.

    """
    way, turn = float(np.hypot(moved[0], moved[1])), abs(float(wrap(moved[2])))
    position = 0.01 + 0.1 * way + 0.02 * turn
    heading = 0.02 + 0.1 * turn + 0.05 * way
    return np.diag([position**-2, position**-2, heading**-2])
