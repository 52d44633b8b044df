# SPDX-License-Identifier: Apache-2.0
"""Convert messages of detections, transforms and remembered objects."""

from __future__ import annotations

from collections.abc import Sequence
import math
from typing import Any

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseWithCovariance
from humanoid_description.rotations import from_quaternion, yaw_of
from humanoid_interfaces.msg import RememberedObject
from humanoid_perception.detection import COLOURS, CUT
from humanoid_perception.finding import place_of
from humanoid_perception.places import Places
from humanoid_perception.planar_poses import Pose2
from humanoid_perception.remembered import RememberedThing
from humanoid_perception.sighting import Sighting
import numpy as np
import numpy.typing as npt
from std_msgs.msg import Header
from vision_msgs.msg import Detection3D, Detection3DArray, ObjectHypothesisWithPose

__all__ = [
    'detections_of',
    'pose_of',
    'remembered_object',
    'sighting_of',
    'time_of',
]

Array = npt.NDArray[np.float64]


def pose_of(transform: Any) -> tuple[Array, Array]:
    """
    Convert a transform to matrices.

    Parameters
    ----------
    transform
        A `geometry_msgs/Transform`; its quaternion need not be normalized.

    Returns
    -------
    tuple of Array
        The position (3,) in m, and the rotation (3, 3).

    """
    q, t = transform.rotation, transform.translation
    rotation = from_quaternion((q.w, q.x, q.y, q.z))
    return np.array([t.x, t.y, t.z]), rotation


def planar_of(transform: Any) -> Pose2:
    """
    Project a transform onto the ground plane: x (m), y (m) and yaw (rad).

    Parameters
    ----------
    transform
        A `geometry_msgs/Transform`.

    """
    position, rotation = pose_of(transform)
    return float(position[0]), float(position[1]), yaw_of(rotation)


def time_of(time_s: float) -> Time:
    """
    Convert a time to a message.

    Parameters
    ----------
    time_s
        The time in s; negative times become zero.

    """
    nanoseconds = max(round(time_s * 1e9), 0)
    return Time(sec=nanoseconds // 1_000_000_000, nanosec=nanoseconds % 1_000_000_000)


def sighting_of(detection: Detection3D, position: Array, rotation: Array) -> Sighting | None:
    """
    Transform a detection into another frame; return None if it names no class.

    Parameters
    ----------
    detection
        The detection: its first result is its class; a further one such as `red mug` names its
        colour.
    position, rotation
        The pose of the detection's frame in the other frame: (3,), (3, 3).

    """
    if not detection.results:
        return None
    best = detection.results[0].hypothesis
    colour = ''
    for result in detection.results[1:]:
        first, _, rest = result.hypothesis.class_id.partition(' ')
        if rest == best.class_id and first in COLOURS:
            colour = first
            break
    centre, size = detection.bbox.center, detection.bbox.size
    at = np.array([centre.position.x, centre.position.y, centre.position.z])
    q = centre.orientation
    yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
    return Sighting(
        best.class_id,
        min(best.score, 1.0),
        position + rotation @ at,
        np.array([size.x, size.y, size.z]),
        math.remainder(yaw + yaw_of(rotation), math.tau),
        colour,
        detection.id == CUT,
    )


def remembered_object(thing: RememberedThing, places: Places) -> RememberedObject:
    """
    Convert an object of the memory to a message, with the names of its surface and room.

    Parameters
    ----------
    thing
        The object.
    places
        The named places, in the frame of the memory.

    """
    message = RememberedObject(
        id=thing.object_id, class_id=thing.class_id, colour=thing.colour, sightings=thing.sightings
    )
    message.place, message.room = place_of(thing, places)
    message.score, message.belief = float(thing.class_score), float(thing.belief)
    message.last_seen = time_of(thing.last_seen_s)
    _fill_pose(message.pose, thing)
    _fill_vector(message.size, thing.size_m)
    return message


def detections_of(header: Header, things: Sequence[RememberedThing]) -> Detection3DArray:
    """
    Convert objects of the memory to detections, each with its id.

    Parameters
    ----------
    header
        The frame of the memory, and the stamp of its last update.
    things
        The objects.

    """
    return Detection3DArray(
        header=header, detections=[_detection(header, each) for each in things]
    )


def _detection(header: Header, thing: RememberedThing) -> Detection3D:
    message = Detection3D(header=header, id=thing.object_id)
    names = [thing.class_id, *([f'{thing.colour} {thing.class_id}'] if thing.colour else [])]
    for name in names:
        result = ObjectHypothesisWithPose()
        result.hypothesis.class_id, result.hypothesis.score = name, float(thing.class_score)
        _fill_pose(result.pose, thing)
        message.results.append(result)
    message.bbox.center = message.results[0].pose.pose
    _fill_vector(message.bbox.size, thing.size_m)
    return message


def _fill_pose(message: PoseWithCovariance, thing: RememberedThing) -> None:
    position = message.pose.position
    position.x, position.y, position.z = (float(each) for each in thing.position_m)
    message.pose.orientation.z = math.sin(thing.yaw_rad / 2)
    message.pose.orientation.w = math.cos(thing.yaw_rad / 2)
    covariance = np.zeros((6, 6))
    covariance[:3, :3] = thing.map_covariance_m2
    covariance[3:, 3:] = -np.eye(3)
    message.covariance = covariance.ravel()


def _fill_vector(message: Any, values: Array) -> None:
    message.x, message.y, message.z = (float(each) for each in values)
