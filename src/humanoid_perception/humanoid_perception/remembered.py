# SPDX-License-Identifier: Apache-2.0
"""State estimate of one remembered object: its position, class, colour and existence."""

from __future__ import annotations

from dataclasses import dataclass, field
import math

from humanoid_perception.planar_poses import Pose2
from humanoid_perception.sighting import greatest_sigma_m, Sighting
import numpy as np
import numpy.typing as npt

__all__ = ['RememberedThing', 'Votes']

Array = npt.NDArray[np.float64]

_FLOOR_M = 0.012
"""Least standard deviation of a position: errors of views from about the same place correlate."""
_LOCALISATION_M = 0.04
"""Standard deviation of the robot's localisation in the map, along an axis."""
_CARRIED_M = 0.02
"""Standard deviation of the position of a held object, along an axis."""
_SURPRISE = 11.3
"""Squared Mahalanobis distance that one detection in a hundred of an object at rest exceeds."""
_MOST_LOOKS = 20.0
"""Largest total weight of a size, in multiples of the greatest weight of one detection."""
_MOST_VOTES = 25.0
"""Largest total weight of votes: older ones fade, so a wrong class does not persist."""
_MOST_LOG_ODDS = 4.0


class Votes:
    """Weighted votes of several detections for the class or the colour of an object."""

    def __init__(self) -> None:
        self.weights: dict[str, float] = {}

    def add(self, name: str, weight: float) -> None:
        """
        Add a vote; older votes fade once there are many.

        Parameters
        ----------
        name
            The class or colour to vote for.
        weight
            The weight of the vote, such as the score of a detection.

        """
        total = sum(self.weights.values()) + weight
        if total > _MOST_VOTES:
            scale = _MOST_VOTES / total
            self.weights = {each: value * scale for each, value in self.weights.items()}
        self.weights[name] = self.weights.get(name, 0.0) + weight

    def absorb(self, other: Votes) -> None:
        """
        Add the votes for another object.

        Parameters
        ----------
        other
            The votes for an object that turned out to be the same.

        """
        for name, weight in other.weights.items():
            self.add(name, weight)

    @property
    def best(self) -> str:
        """Return the name with the most votes; empty without votes."""
        return max(self.weights, key=lambda name: self.weights[name], default='')

    def share(self, name: str) -> float:
        """
        Return the fraction of the votes that a name has, from 0 to 1.

        Parameters
        ----------
        name
            The class or colour; 0 is returned for one without votes.

        """
        total = sum(self.weights.values())
        return self.weights.get(name, 0.0) / total if total else 0.0


@dataclass
class RememberedThing:
    """
    A remembered object.

    The position is estimated by a Kalman filter for an object at rest; the size is a mean of the
    detections, in which near ones weigh more. `log_odds` are the log odds that the object exists
    and is still there.
    """

    position_m: Array
    covariance_m2: Array
    size_m: Array
    yaw_rad: float
    first_seen_s: float
    last_seen_s: float
    object_id: str = ''
    """Assigned when the object is confirmed, and kept from then on; empty before."""
    sightings: int = 0
    log_odds: float = 0.0
    score: float = 0.0
    """The mean score of its detections."""
    classes: Votes = field(default_factory=Votes)
    colours: Votes = field(default_factory=Votes)
    missed: int = 0
    """Number of consecutive images in which it should have been detected, and was not."""
    empty: int = 0
    """Number of these in which the depth image showed an empty place."""
    size_weight: float = 0.0
    nearest_weight: float = 0.0
    """The sum of the weights of the detections that the size averages, and the greatest weight."""
    anchor: Pose2 = (0.0, 0.0, 0.0)
    """The pose of `odom` in the map when the object was last seen."""

    @classmethod
    def of(
        cls, sighting: Sighting, noise_m2: Array, time_s: float, log_odds: float
    ) -> RememberedThing:
        """
        Initialize an object from its first detection.

        Parameters
        ----------
        sighting
            The detection, not cut by the image border.
        noise_m2
            The covariance (3, 3) of its position, as from `sighting_noise`.
        time_s
            The stamp of the image.
        log_odds
            The initial log odds that the object exists.

        """
        thing = cls(
            sighting.position_m.copy(),
            noise_m2.copy(),
            sighting.size_m.copy(),
            sighting.yaw_rad,
            time_s,
            time_s,
            log_odds=log_odds,
        )
        _grow(thing, sighting, noise_m2)
        _note(thing, sighting, time_s)
        return thing

    @property
    def class_id(self) -> str:
        """Return the class of the object: the one with the most votes."""
        return self.classes.best

    @property
    def colour(self) -> str:
        """Return the colour of the object; empty unless it has at least half of the votes."""
        best = self.colours.best
        return best if self.colours.share(best) >= 0.5 else ''

    @property
    def belief(self) -> float:
        """Return the probability that the object is still there, from 0 to 1."""
        return 1.0 / (1.0 + math.exp(-self.log_odds))

    @property
    def class_score(self) -> float:
        """Return the confidence in its class, 0 to 1: the mean score times the share of votes."""
        return min(self.score * self.classes.share(self.class_id), 1.0)

    @property
    def sigma_m(self) -> float:
        """Return the greatest standard deviation of its position relative to the robot."""
        return greatest_sigma_m(self.covariance_m2)

    @property
    def map_covariance_m2(self) -> Array:
        """
        Return the covariance (3, 3) of its position in the map.

        It includes the localisation error of the robot, which all detections share, so that more
        of them do not reduce it.
        """
        return self.covariance_m2 + _LOCALISATION_M**2 * np.diag((1.0, 1.0, 0.0))

    def drift(self, passed_s: float, rate_m2_s: float, most_m: float) -> None:
        """
        Run the prediction step of the Kalman filter: the covariance grows with time.

        Parameters
        ----------
        passed_s
            The elapsed time; negative values count as zero.
        rate_m2_s
            The growth rate of the variance along each axis, in m^2/s.
        most_m
            The standard deviation along an axis at which the growth stops.

        """
        grown = self.covariance_m2 + max(passed_s, 0.0) * rate_m2_s * np.eye(3)
        if np.max(np.diag(grown)) <= most_m**2:
            self.covariance_m2 = grown

    def take(self, sighting: Sighting, noise_m2: Array, time_s: float) -> None:
        """
        Update the object with a detection that was associated with it.

        Parameters
        ----------
        sighting
            The detection; if the image border cuts it, position and size are kept.
        noise_m2
            The covariance (3, 3) of its position, as from `sighting_noise`.
        time_s
            The stamp of the image.

        """
        if not sighting.is_cut:
            self._move(sighting.position_m, noise_m2)
            _grow(self, sighting, noise_m2)
        _note(self, sighting, time_s)

    def believe(self, change: float) -> None:
        """
        Change the log odds that the object is there, within bounds.

        Parameters
        ----------
        change
            The amount to add to the log odds.

        """
        self.log_odds = max(-_MOST_LOG_ODDS, min(_MOST_LOG_ODDS, self.log_odds + change))

    def carry(self, position_m: Array, time_s: float) -> None:
        """
        Set the position of an object that a hand holds.

        Parameters
        ----------
        position_m
            The position in the hand (3,), in the frame of the memory.
        time_s
            The stamp of the current image.

        """
        self.position_m = position_m.copy()
        self.covariance_m2 = _CARRIED_M**2 * np.eye(3)
        self.last_seen_s = max(self.last_seen_s, time_s)
        self.missed = self.empty = 0

    def distance2(self, sighting: Sighting, noise_m2: Array) -> float:
        """
        Compute the squared Mahalanobis distance of a detection from the object.

        Parameters
        ----------
        sighting
            The detection.
        noise_m2
            The covariance (3, 3) of its position, which is added to that of the object.

        """
        error = sighting.position_m - self.position_m
        return float(error @ np.linalg.solve(self.covariance_m2 + noise_m2, error))

    def absorb(self, other: RememberedThing) -> None:
        """
        Merge another object that turned out to be the same into this one.

        Parameters
        ----------
        other
            The object that will be dropped.

        """
        self._move(other.position_m, other.covariance_m2)
        if other.size_weight > self.size_weight:
            self.size_m, self.yaw_rad = other.size_m, other.yaw_rad
            self.size_weight, self.nearest_weight = other.size_weight, other.nearest_weight
        self.classes.absorb(other.classes)
        self.colours.absorb(other.colours)
        together = self.sightings + other.sightings
        self.score = (self.score * self.sightings + other.score * other.sightings) / together
        self.sightings = together
        self.log_odds = max(self.log_odds, other.log_odds)
        self.first_seen_s = min(self.first_seen_s, other.first_seen_s)
        if other.last_seen_s > self.last_seen_s:
            self.last_seen_s, self.anchor = other.last_seen_s, other.anchor
        self.missed, self.empty = min(self.missed, other.missed), min(self.empty, other.empty)

    def move_by(self, shift: Pose2) -> None:
        """
        Move the object along with a corrected frame.

        Parameters
        ----------
        shift
            The motion in the frame of the memory, as from `shift_between`: rotate about its origin
            by yaw (rad), then translate by x and y (m).

        """
        x, y, yaw = shift
        c, s = math.cos(yaw), math.sin(yaw)
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        self.position_m = turn @ self.position_m + np.array([x, y, 0.0])
        self.covariance_m2 = turn @ self.covariance_m2 @ turn.T
        self.yaw_rad = math.remainder(self.yaw_rad + yaw, math.tau)

    def _move(self, position_m: Array, noise_m2: Array) -> None:
        """Run the update step of the Kalman filter; inflate the covariance of a moved object."""
        error = position_m - self.position_m
        total = self.covariance_m2 + noise_m2
        if float(error @ np.linalg.solve(total, error)) > _SURPRISE:
            self.covariance_m2 = self.covariance_m2 + 0.3 * np.outer(error, error)
            total = self.covariance_m2 + noise_m2
        gain = np.linalg.solve(total, self.covariance_m2).T
        self.position_m = self.position_m + gain @ error
        rest = (np.eye(3) - gain) @ self.covariance_m2
        values, vectors = np.linalg.eigh(0.5 * (rest + rest.T))
        self.covariance_m2 = (vectors * np.maximum(values, _FLOOR_M**2)) @ vectors.T


def _grow(thing: RememberedThing, sighting: Sighting, noise_m2: Array) -> None:
    """Update the size as a weighted mean, and the yaw from the best detections."""
    weight = sighting.score / float(np.trace(noise_m2))
    if weight >= 0.5 * thing.nearest_weight:
        thing.yaw_rad = sighting.yaw_rad
    thing.nearest_weight = max(weight, thing.nearest_weight)
    thing.size_weight = min(thing.size_weight + weight, _MOST_LOOKS * thing.nearest_weight)
    thing.size_m = thing.size_m + weight / thing.size_weight * (sighting.size_m - thing.size_m)


def _note(thing: RememberedThing, sighting: Sighting, time_s: float) -> None:
    """Count a detection, and vote for its class and colour."""
    thing.classes.add(sighting.class_id, sighting.score * (0.5 if sighting.is_cut else 1.0))
    if sighting.colour:
        thing.colours.add(sighting.colour, sighting.score)
    thing.sightings += 1
    thing.score += (sighting.score - thing.score) / min(thing.sightings, 20)
    thing.last_seen_s = max(thing.last_seen_s, time_s)
    thing.missed = thing.empty = 0
