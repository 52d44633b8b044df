# SPDX-License-Identifier: Apache-2.0
"""Object memory: multi-object tracking of detections, including objects out of view."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
import math
from types import MappingProxyType

from humanoid_perception.association import associate, has_moved, is_same
from humanoid_perception.object_ids import ObjectIds
from humanoid_perception.planar_poses import composed, offset_m, Pose2, shift_between
from humanoid_perception.remembered import RememberedThing
from humanoid_perception.sighting import Sighting, sighting_noise
from humanoid_perception.visibility import corners_of, Evidence, evidence_at, View
import numpy as np
import numpy.typing as npt

__all__ = ['MemorySettings', 'ObjectMemory']

Array = npt.NDArray[np.float64]

_LOSS = {Evidence.EMPTY: 0.8, Evidence.UNKNOWN: 0.35, Evidence.SOMETHING: 0.05}
"""Decrease of the log odds of an object by a view that should have detected it."""
_TENTATIVE_LOSS = 4.0
"""Factor of that decrease while the object is not confirmed."""
_START, _BORN, _FORGOTTEN = -1.0, 0.8, -1.0
"""Log odds before the first detection, for confirmation, and below which an object is dropped."""
_TENTATIVE_S = 30.0
"""How long an unconfirmed object is kept without being seen."""
_CALM_RAD_S = 0.5
"""Turn rate of the camera above which missing detections are ignored."""
_JUMP_M, _JUMP_RAD = 0.15, 0.10
"""Motion of the odom frame above which a correction counts as a jump, and not as drift."""
_IN_HAND_M = 0.15
"""A detection this near to a hand, or to a held object, is that hand or object."""


@dataclass(frozen=True)
class MemorySettings:
    """
    Settings of the object memory.

    Attributes
    ----------
    birth_sightings
        The number of detections after which an object is confirmed.
    max_range_m
        The largest distance at which an object must be detected if it is there.
    min_size_px
        The smallest size in the image at which it must be detected.
    drift_m_s
        The growth of the standard deviation of positions in the first second; it grows with the
        square root of time.
    max_things
        The maximum number of objects; beyond it, those with the lowest belief are dropped.
    follows_jumps
        Whether objects move along when the localisation corrects an error. They must not where it
        jumps because the robot was carried.

    """

    birth_sightings: int = 3
    max_range_m: float = 3.0
    min_size_px: float = 8.0
    drift_m_s: float = 0.003
    max_things: int = 300
    follows_jumps: bool = True


class ObjectMemory:
    """
    Memory of objects, updated with each view of the camera and its detections.

    Parameters
    ----------
    settings
        The settings.

    Notes
    -----
    Detections are associated with objects by minimising the sum of squared Mahalanobis distances,
    with penalties for another class, colour or size. The existence of an object is estimated by
    log odds: detections raise them by their score, and views that should have detected the object
    and did not lower them.

    """

    def __init__(self, settings: MemorySettings = MemorySettings()) -> None:
        self.settings = settings
        self._all: list[RememberedThing] = []
        self._ids = ObjectIds()
        self._time_s = -math.inf
        self._anchor: Pose2 | None = None

    @property
    def things(self) -> list[RememberedThing]:
        """Return the confirmed objects, the one known longest first."""
        return [thing for thing in self._all if thing.object_id]

    @property
    def tentative_count(self) -> int:
        """Return the number of objects that are not confirmed yet."""
        return sum(not thing.object_id for thing in self._all)

    def clear(self) -> None:
        """Clear the memory, including the counters of ids."""
        self._all, self._ids = [], ObjectIds()
        self._time_s, self._anchor = -math.inf, None

    def move_all(self, shift: Pose2) -> None:
        """
        Transform all objects into another frame of the memory.

        Parameters
        ----------
        shift
            The pose of the current frame in the new one: x (m), y (m), yaw (rad).

        """
        for thing in self._all:
            thing.move_by(shift)
            thing.anchor = composed(shift, thing.anchor)
        if self._anchor is not None:
            self._anchor = composed(shift, self._anchor)

    def look(
        self,
        view: View,
        sightings: Iterable[Sighting],
        anchor: Pose2 = (0.0, 0.0, 0.0),
        held_m: Mapping[str, Array] = MappingProxyType({}),
        hands_m: Sequence[Array] = (),
    ) -> None:
        """
        Update the memory with a view of the camera and its detections.

        Parameters
        ----------
        view
            The view, with its depth.
        sightings
            The detections in it, in the same frame; invalid ones are ignored.
        anchor
            The pose of the odom frame in the memory frame. When it jumps, objects seen under the
            same anchor move along.
        held_m
            The positions of held objects (3,), by id, in the same frame.
        hands_m
            The positions of the robot's own hands (3,). Detections near them are ignored, as the
            hands themselves look like objects; objects remembered there are kept.

        """
        self._correct(anchor, view)
        passed_s = min(max(view.time_s - self._time_s, 0.0), 60.0)
        self._time_s = view.time_s
        for thing in self._all:
            thing.drift(passed_s, self.settings.drift_m_s**2, 0.3)
        own = [*held_m.values(), *hands_m]
        sound = [
            sighting
            for sighting in sightings
            if sighting.is_sound and not _is_near(sighting.position_m, own)
        ]
        carried = [each for each in self._all if each.object_id in held_m]
        for thing in carried:
            thing.carry(held_m[thing.object_id], view.time_s)
            thing.anchor = anchor
        seen = self._recognise(view, sound)
        hidden = [each for each in self._all if _is_near(each.position_m, own)]
        self._miss(view, [*seen, *carried, *hidden])
        self._merge(seen)
        self._give_ids()
        self._forget()

    def _correct(self, anchor: Pose2, view: View) -> None:
        """Move the objects that were seen under an anchor that a jump has invalidated."""
        old, self._anchor = self._anchor, anchor
        if old is None or old == anchor or not self.settings.follows_jumps:
            return
        shift = shift_between(old, anchor)
        if not _is_jump(shift, view.position_m):
            return
        for thing in self._all:
            if not _is_jump(shift_between(thing.anchor, old), thing.position_m):
                thing.move_by(shift)
                thing.anchor = anchor

    def _recognise(self, view: View, sightings: Sequence[Sighting]) -> list[RememberedThing]:
        """Associate detections with objects; return the objects seen, including new ones."""
        noises = [
            sighting_noise(each.position_m, view.position_m, view.turn_rad_s) for each in sightings
        ]
        doubts = [self._doubt_m2(thing) for thing in self._all] if sightings else []
        partner = dict(associate(sightings, noises, self._all, doubts))
        seen = []
        for row, (sighting, noise) in enumerate(zip(sightings, noises, strict=True)):
            gain = _gain(sighting.score)
            if row in partner:
                thing = self._all[partner[row]]
                thing.take(sighting, noise, view.time_s)
                thing.believe(0.5 * gain if sighting.is_cut else gain)
            elif sighting.is_cut:
                continue
            else:
                thing = RememberedThing.of(sighting, noise, view.time_s, _START + gain)
                self._all.append(thing)
            assert self._anchor is not None
            thing.anchor = self._anchor
            seen.append(thing)
        return seen

    def _doubt_m2(self, thing: RememberedThing) -> Array:
        """
        Compute the covariance (3, 3) that corrections of the localisation add to a position.

        It is not known when the error began that they make up for: the object is where it was
        seen, or where they would take it.
        """
        assert self._anchor is not None
        off = np.zeros(3)
        off[:2] = offset_m(shift_between(thing.anchor, self._anchor), thing.position_m)
        return np.outer(off, off)

    def _miss(self, view: View, seen: Sequence[RememberedThing]) -> None:
        """Lower the log odds of objects that should have been detected."""
        if view.turn_rad_s > _CALM_RAD_S:
            return
        seen_ids = {id(thing) for thing in seen}
        for thing in self._all:
            if id(thing) in seen_ids:
                continue
            evidence = evidence_at(
                view,
                thing.position_m,
                thing.size_m,
                thing.yaw_rad,
                sigma_m=thing.sigma_m,
                max_range_m=self.settings.max_range_m,
                min_size_px=self.settings.min_size_px,
            )
            if evidence is Evidence.UNKNOWN and self._is_behind_another(view, thing):
                continue
            if evidence is not Evidence.NONE:
                thing.missed += 1
                thing.empty += evidence is Evidence.EMPTY
                loss = _LOSS[evidence] * (1.0 if thing.object_id else _TENTATIVE_LOSS)
                thing.believe(-loss)

    def _is_behind_another(self, view: View, thing: RememberedThing) -> bool:
        """Whether another object occludes the centre of an object."""
        pixel, depth = view.project(thing.position_m[None])
        for other in self.things:
            if other is thing:
                continue
            corners, depths = view.project(
                corners_of(other.position_m, other.size_m, other.yaw_rad)
            )
            covers = (corners.min(axis=0) <= pixel[0]) & (pixel[0] <= corners.max(axis=0))
            if covers.all() and 0.05 < depths.max() < depth[0]:
                return True
        return False

    def _merge(self, seen: Sequence[RememberedThing]) -> None:
        """Merge pairs of objects at a place where there can be only one."""
        seen_ids = {id(thing) for thing in seen}
        for thing in seen:
            for other in list(self._all):
                if other is thing or not any(thing is each for each in self._all):
                    continue
                are_both_seen = id(other) in seen_ids
                if are_both_seen and other.class_id == thing.class_id:
                    continue
                if is_same(thing, other):
                    kept, dropped = _older_first(thing, other)
                    kept.absorb(dropped)
                    self._all = [each for each in self._all if each is not dropped]

    def _give_ids(self) -> None:
        """Confirm objects that were seen often enough, and assign their ids."""
        for thing in list(self._all):
            enough = thing.sightings >= self.settings.birth_sightings
            if not thing.object_id and enough and thing.log_odds >= _BORN:
                thing.object_id = self._old_id(thing) or self._ids.new(thing)

    def _old_id(self, thing: RememberedThing) -> str:
        """Reuse the id of a matching object that is gone from its place; empty without one."""
        kind = thing.class_id, thing.colour
        for other in self.things:
            if (other.class_id, other.colour) == kind and has_moved(other, thing):
                self._all = [each for each in self._all if each is not other]
                return other.object_id
        return self._ids.found_again(thing, self._time_s)

    def _forget(self) -> None:
        """Drop objects that are no longer believed, and those above the maximum number."""
        kept = []
        for thing in self._all:
            is_stale = not thing.object_id and self._time_s - thing.last_seen_s > _TENTATIVE_S
            if thing.log_odds > _FORGOTTEN - (0.0 if thing.object_id else 1.0) and not is_stale:
                kept.append(thing)
            elif thing.object_id:
                self._ids.lose(thing, self._time_s)
        if len(kept) > self.settings.max_things:
            ranked = sorted(
                kept, key=lambda each: (bool(each.object_id), each.log_odds, each.last_seen_s)
            )
            count = len(kept) - self.settings.max_things
            dropped = {id(each) for each in ranked[:count]}
            kept = [each for each in kept if id(each) not in dropped]
        self._ids.keep(self.settings.max_things)
        self._all = kept


def _gain(score: float) -> float:
    """
    Compute by how much a detection raises the log odds of its object.

    Detections with a high score are mostly right, those with a low score often wrong, and
    repeatedly so at the same place.
    """
    return min(max(2.5 * (score - 0.45), 0.05), 1.4)


def _is_jump(shift: Pose2, at_m: Array) -> bool:
    """Whether a motion of a frame, at a point (3,), is more than a correction of drift."""
    return math.hypot(*offset_m(shift, at_m)) > _JUMP_M or abs(shift[2]) > _JUMP_RAD


def _is_near(position_m: Array, own_m: Iterable[Array]) -> bool:
    """Whether a position is near one of the robot's hands or the objects that they hold."""
    return any(math.dist(position_m, at) < _IN_HAND_M for at in own_m)


def _older_first(
    thing: RememberedThing, other: RememberedThing
) -> tuple[RememberedThing, RememberedThing]:
    """Order two objects for merging: the confirmed one, or the one seen more often, first."""
    ranked = sorted((thing, other), key=lambda each: (not each.object_id, -each.sightings))
    return ranked[0], ranked[1]
