# SPDX-License-Identifier: Apache-2.0
"""What is known of one thing: where it is, what it is, and whether it still is there."""

from __future__ import annotations

from dataclasses import dataclass, field
import math

import numpy as np
import numpy.typing as npt

__all__ = ['RememberedThing', 'Sighting', 'Votes', 'greatest_sigma_m', 'sighting_noise']

Array = npt.NDArray[np.float64]
Pose2 = tuple[float, float, float]
"""A pose in a plane: x (m), y (m), yaw (rad)."""

_FLOOR_M = 0.012
"""Looks from about the same place err alike: none makes a position surer than this."""
_LOCALISATION_M = 0.04
"""The standard deviation of where the robot believes to be in the map, along an axis."""
_CARRIED_M = 0.02
"""How exactly it is known where a hand has brought a thing."""
_SURPRISE = 11.3
"""A squared Mahalanobis distance that one look of a hundred exceeds, if the thing is at rest."""
_MOST_LOOKS = 20.0
"""Of how many looks from near a size is the mean, at most."""
_MOST_VOTES = 25.0
"""Older looks count less, so that a wrong class does not stay for ever."""
_MOST_LOG_ODDS = 4.0


@dataclass(frozen=True)
class Sighting:
    """
    One detection in space, in the frame of the memory.

    Attributes
    ----------
    class_id, score
        What it may be, and how sure that is, from 0 to 1.
    position_m, size_m, yaw_rad
        Its upright box: middle (3,), sides (3,), heading.
    colour
        The name of its colour; empty if it is not known.
    is_cut
        Whether the border of the picture cuts it, so that position and size are not to be trusted.

    """

    class_id: str
    score: float
    position_m: Array
    size_m: Array
    yaw_rad: float = 0.0
    colour: str = ''
    is_cut: bool = False

    @property
    def is_sound(self) -> bool:
        """Whether all of it are numbers that can be."""
        numbers = (self.score, *self.position_m, *self.size_m, self.yaw_rad)
        if not all(map(math.isfinite, numbers)) or not self.class_id:
            return False
        return 0.0 < self.score <= 1.0 and 0.0 < min(self.size_m) and max(self.size_m) < 5.0


def sighting_noise(
    position_m: Array, camera_m: Array, turn_rad_s: float = 0.0, base_m: float = 0.015
) -> Array:
    """
    Estimate the covariance (3, 3) in m^2 of the position of a detection.

    Along the ray the error of depth grows with the square of the range, as that of stereo and
    structured light does; across it, that of the direction with the range, and faster while the
    camera turns.

    Parameters
    ----------
    position_m, camera_m
        Where the detection and the camera are (3,), in the frame of the covariance.
    turn_rad_s
        How fast the camera turns.
    base_m
        The standard deviation along each axis that the pose of the camera adds.

    """
    ray = position_m - camera_m
    range_m = max(float(np.linalg.norm(ray)), 1e-3)
    ahead = np.outer(ray, ray) / range_m**2
    along_m = 0.01 + 0.012 * range_m**2
    across_m = range_m * (0.010 + 0.03 * abs(turn_rad_s))
    noise = across_m**2 * (np.eye(3) - ahead) + along_m**2 * ahead
    return np.asarray(noise + base_m**2 * np.eye(3))


def greatest_sigma_m(covariance_m2: Array) -> float:
    """
    Compute the greatest standard deviation in m along an axis of the frame.

    Parameters
    ----------
    covariance_m2
        The covariance (n, n) of a position in m^2.

    """
    return math.sqrt(float(np.max(np.diag(covariance_m2))))


class Votes:
    """What several looks say, by weight: the class or the colour of a thing."""

    def __init__(self) -> None:
        self.weights: dict[str, float] = {}

    def add(self, name: str, weight: float) -> None:
        """
        Count a vote; the older ones fade once there are many.

        Parameters
        ----------
        name
            The class or colour that it is for.
        weight
            How much it counts, such as the score of a detection.

        """
        total = sum(self.weights.values()) + weight
        if total > _MOST_VOTES:
            scale = _MOST_VOTES / total
            self.weights = {each: value * scale for each, value in self.weights.items()}
        self.weights[name] = self.weights.get(name, 0.0) + weight

    def absorb(self, other: Votes) -> None:
        """
        Add the votes of another.

        Parameters
        ----------
        other
            The votes for an object that turned out to be the same one.

        """
        for name, weight in other.weights.items():
            self.add(name, weight)

    @property
    def best(self) -> str:
        """Return the name with most votes; empty without any."""
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
    A thing that was seen.

    The position is that of a Kalman filter for a thing at rest; the size is a mean, weighted by
    how near it was seen. `log_odds` is how sure it is that the thing exists and still is there.
    """

    position_m: Array
    covariance_m2: Array
    size_m: Array
    yaw_rad: float
    first_seen_s: float
    last_seen_s: float
    object_id: str = ''
    """Given once it is believed, and kept then."""
    sightings: int = 0
    log_odds: float = 0.0
    score: float = 0.0
    """The mean score of its detections."""
    classes: Votes = field(default_factory=Votes)
    colours: Votes = field(default_factory=Votes)
    missed: int = 0
    """In how many looks in a row it should have been detected, and was not."""
    empty: int = 0
    """In how many of these one saw that there was nothing."""
    size_weight: float = 0.0
    nearest_weight: float = 0.0
    """The sum of the weights of the looks of which the size is the mean, and the greatest one."""
    anchor: Pose2 = (0.0, 0.0, 0.0)
    """Where `odom` was in the map when it was seen last."""

    @classmethod
    def of(
        cls, sighting: Sighting, noise_m2: Array, time_s: float, log_odds: float
    ) -> RememberedThing:
        """
        Initialize an object from its first detection.

        Parameters
        ----------
        sighting
            The detection, not cut by the border of the picture.
        noise_m2
            The covariance (3, 3) of its position, as of `sighting_noise`.
        time_s
            The stamp of the picture.
        log_odds
            How sure it is that the object exists.

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
        thing._grow(sighting, noise_m2)
        thing._note(sighting, time_s)
        return thing

    @property
    def class_id(self) -> str:
        """Return what it is."""
        return self.classes.best

    @property
    def colour(self) -> str:
        """Its colour; empty unless most looks at its colour say the same."""
        best = self.colours.best
        return best if self.colours.share(best) >= 0.5 else ''

    @property
    def belief(self) -> float:
        """How sure it is that it still is there, from 0 to 1."""
        return 1.0 / (1.0 + math.exp(-self.log_odds))

    @property
    def class_score(self) -> float:
        """How sure its class is: the mean score, times the share of votes; from 0 to 1."""
        return min(self.score * self.classes.share(self.class_id), 1.0)

    @property
    def sigma_m(self) -> float:
        """How unsure its position is, as seen by the robot: `greatest_sigma_m`."""
        return greatest_sigma_m(self.covariance_m2)

    @property
    def map_covariance_m2(self) -> Array:
        """
        Return the covariance (3, 3) of its position in the map.

        It also holds how exactly the robot knows where it is. All sightings have that error in
        common, so that more of them do not lessen it.
        """
        return self.covariance_m2 + _LOCALISATION_M**2 * np.diag((1.0, 1.0, 0.0))

    def drift(self, passed_s: float, rate_m2_s: float, most_m: float) -> None:
        """
        Predict the Kalman filter: let the position become less sure while time passes.

        Parameters
        ----------
        passed_s
            How much time has passed; a negative one counts as none.
        rate_m2_s
            By how much the variance along each axis grows, in m^2/s.
        most_m
            The standard deviation along an axis beyond which it does not grow.

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
            The detection; if the border of the picture cuts it, position and size stay.
        noise_m2
            The covariance (3, 3) of its position, as of `sighting_noise`.
        time_s
            The stamp of the picture.

        """
        if not sighting.is_cut:
            self._move(sighting.position_m, noise_m2)
            self._grow(sighting, noise_m2)
        self._note(sighting, time_s)

    def _note(self, sighting: Sighting, time_s: float) -> None:
        """Count a detection, and vote for its class and colour."""
        self.classes.add(sighting.class_id, sighting.score * (0.5 if sighting.is_cut else 1.0))
        if sighting.colour:
            self.colours.add(sighting.colour, sighting.score)
        self.sightings += 1
        self.score += (sighting.score - self.score) / min(self.sightings, 20)
        self.last_seen_s = max(self.last_seen_s, time_s)
        self.missed = self.empty = 0

    def believe(self, change: float) -> None:
        """
        Change how sure it is that the object is there, within bounds.

        Parameters
        ----------
        change
            What is added to the log odds.

        """
        self.log_odds = max(-_MOST_LOG_ODDS, min(_MOST_LOG_ODDS, self.log_odds + change))

    def carry(self, position_m: Array, time_s: float) -> None:
        """
        Set the position of an object that a hand holds.

        Parameters
        ----------
        position_m
            Where the hand has brought it (3,), in the frame of the memory.
        time_s
            The stamp of the picture that belongs to it.

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
            The covariance (3, 3) of its position, which adds to that of the object.

        """
        error = sighting.position_m - self.position_m
        return float(error @ np.linalg.solve(self.covariance_m2 + noise_m2, error))

    def absorb(self, other: RememberedThing) -> None:
        """
        Merge another object that turned out to be the same into this one.

        Parameters
        ----------
        other
            The object that is to be dropped.

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
        Move the object with a frame that turned out to be elsewhere.

        Parameters
        ----------
        shift
            The motion in the frame of the memory, as of `memory.shift_between`: turn about its
            origin by yaw (rad), then move by x and y (m).

        """
        x, y, yaw = shift
        c, s = math.cos(yaw), math.sin(yaw)
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        self.position_m = turn @ self.position_m + np.array([x, y, 0.0])
        self.covariance_m2 = turn @ self.covariance_m2 @ turn.T
        self.yaw_rad = math.remainder(self.yaw_rad + yaw, math.tau)

    def _move(self, position_m: Array, noise_m2: Array) -> None:
        """Update the position: Kalman's filter, which a thing that has moved makes less sure."""
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

    def _grow(self, sighting: Sighting, noise_m2: Array) -> None:
        """Update the size; the heading is that of the best look."""
        weight = sighting.score / float(np.trace(noise_m2))
        if weight >= 0.5 * self.nearest_weight:
            self.yaw_rad = sighting.yaw_rad
        self.nearest_weight = max(weight, self.nearest_weight)
        self.size_weight = min(self.size_weight + weight, _MOST_LOOKS * self.nearest_weight)
        self.size_m = self.size_m + weight / self.size_weight * (sighting.size_m - self.size_m)
