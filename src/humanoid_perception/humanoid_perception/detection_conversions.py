# SPDX-License-Identifier: Apache-2.0
"""Convert detections to vision_msgs and annotated images."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
import math
from typing import Any

import cv2
from geometry_msgs.msg import Pose
from humanoid_perception.detection import Box3, Color, CUT, Detection
from humanoid_perception.images import data_of
import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import Image
from std_msgs.msg import Header
from vision_msgs.msg import (
    Detection2D,
    Detection2DArray,
    Detection3D,
    Detection3DArray,
    ObjectHypothesis,
    ObjectHypothesisWithPose,
)

__all__ = ['annotated', 'detections_2d', 'detections_3d', 'named']

Array = npt.NDArray[np.float64]
_LINE = (255, 196, 0)
_TEXT = (16, 16, 16)


def named(detection: Detection) -> str:
    """
    Join the colour and the class of a detection, such as 'red mug'.

    Parameters
    ----------
    detection
        The detection; without a colour, its class alone is returned.

    """
    return f'{detection.colour} {detection.class_id}'.strip()


def detections_2d(header: Header, found: Iterable[Detection]) -> Detection2DArray:
    """
    Convert detections to a message with boxes in the image, in pixels.

    Parameters
    ----------
    header
        The header of the image.
    found
        The detections.

    Returns
    -------
    Detection2DArray
        The first result of each detection is its class, the second the class with its colour if
        known. The id is `CUT` where the image border cuts the object, otherwise empty.

    """
    message = Detection2DArray(header=header)
    for detection in found:
        left, top, right, bottom = detection.box_px
        each = Detection2D(header=header, id=CUT if detection.is_cut else '')
        each.bbox.center.position.x = (left + right) / 2.0
        each.bbox.center.position.y = (top + bottom) / 2.0
        each.bbox.size_x, each.bbox.size_y = right - left, bottom - top
        each.results = _results(detection, Pose())
        message.detections.append(each)
    return message


def detections_3d(
    header: Header, found: Sequence[tuple[Detection, Box3]], rotation: Array | None = None
) -> Detection3DArray:
    """
    Convert detections to a message with 3-D boxes.

    Parameters
    ----------
    header
        The frame of the message, and the stamp of the image.
    found
        The detections with their boxes.
    rotation
        The rotation (3, 3) of the frame of the boxes, whose z axis points up, in the frame of the
        message; None if both are the same.

    """
    message = Detection3DArray(header=header)
    for detection, box in found:
        each = Detection3D(header=header, id=CUT if detection.is_cut else '')
        pose = _pose(box, rotation)
        each.results = _results(detection, pose)
        each.bbox.center = pose
        each.bbox.size.x, each.bbox.size.y, each.bbox.size.z = (float(s) for s in box.size_m)
        message.detections.append(each)
    return message


def _results(detection: Detection, pose: Pose) -> list[ObjectHypothesisWithPose]:
    """Create the hypotheses: the class, and the class with its colour if known."""
    scores = {detection.class_id: detection.score}
    if detection.colour:
        scores[named(detection)] = detection.score * detection.colour_share
    results = []
    for name, score in scores.items():
        result = ObjectHypothesisWithPose(
            hypothesis=ObjectHypothesis(class_id=name, score=float(score))
        )
        result.pose.pose = pose
        results.append(result)
    return results


def _pose(box: Box3, rotation: Array | None) -> Pose:
    pose = Pose()
    centre = box.centre_m if rotation is None else rotation @ box.centre_m
    pose.position.x, pose.position.y, pose.position.z = (float(value) for value in centre)
    if rotation is None:
        z, w = math.sin(box.yaw_rad / 2.0), math.cos(box.yaw_rad / 2.0)
        pose.orientation.z, pose.orientation.w = z, w
    else:
        turn = Rotation.from_matrix(rotation) * Rotation.from_euler('z', box.yaw_rad)
        q = pose.orientation
        q.x, q.y, q.z, q.w = (float(value) for value in turn.as_quat())
    return pose


def annotated(header: Header, color: Color, found: Iterable[Detection]) -> Image:
    """
    Draw detections into a copy of an image: boxes, names and scores.

    Parameters
    ----------
    header
        The header of the image, for the message.
    color
        The image (height, width, 3): red, green, blue.
    found
        The detections.

    Returns
    -------
    Image
        The message, in the encoding `rgb8`.

    """
    picture = np.array(color)
    scale = max(0.35, min(picture.shape[:2]) / 800.0)
    for detection in found:
        left, top, right, bottom = (round(edge) for edge in detection.box_px)
        text = f'{named(detection)} {detection.score:.2f}'
        cv2.rectangle(picture, (left, top), (right - 1, bottom - 1), _LINE, 1)
        (width, height), below = cv2.getTextSize(text, cv2.FONT_HERSHEY_SIMPLEX, scale, 1)
        x = max(0, min(left, picture.shape[1] - width))
        y = (
            top - below
            if top >= height + 2 * below
            else min(bottom + height + below, len(picture) - below)
        )
        cv2.rectangle(picture, (x, y - height - 1), (x + width, y + below - 1), _LINE, cv2.FILLED)
        cv2.putText(picture, text, (x, y), cv2.FONT_HERSHEY_SIMPLEX, scale, _TEXT, 1, cv2.LINE_AA)
    return image_of(header, picture)


def image_of(header: Header, picture: Color) -> Image:
    """
    Convert an RGB array to an image message in the encoding `rgb8`.

    Parameters
    ----------
    header
        The header of the message.
    picture
        The image (height, width, 3): red, green, blue.

    """
    height, width = picture.shape[:2]
    image = Image(header=header, height=height, width=width, encoding='rgb8', step=3 * width)
    image.data = data_of(picture)
    return image


def header_of(source: Any, frame_id: str) -> Header:
    """
    Create a header with the stamp of another one, in a given frame.

    Parameters
    ----------
    source
        The `std_msgs/Header` with the stamp.
    frame_id
        The frame.

    """
    return Header(stamp=source.stamp, frame_id=frame_id)
