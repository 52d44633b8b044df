# SPDX-License-Identifier: Apache-2.0
"""The poses of all frames in a fixed frame."""

from __future__ import annotations

from collections.abc import Mapping

from tf2_py._link import Sample
from tf2_py._pose import chain, IDENTITY, inverse, Pose

__all__ = ['placed', 'roots']

MAX_LINKS = 1000


def roots(samples: Mapping[str, Sample]) -> dict[str, tuple[str, Pose]]:
    """
    Find the root of each frame, and the pose of the frame in it.

    Parameters
    ----------
    samples
        The newest sample of each frame that has a parent, by the name of the frame.

    Returns
    -------
    dict[str, tuple[str, Pose]]
        The root and the pose, also for the roots themselves; none for frames in loops.

    """
    found: dict[str, tuple[str, Pose]] = {}
    for frame in samples:
        _climb(frame, samples, found)
    return found


def placed(
    samples: Mapping[str, Sample], fixed: str
) -> tuple[dict[str, Pose], dict[str, list[str]]]:
    """
    Compute the poses of all frames in a fixed frame.

    Parameters
    ----------
    samples
        As for `roots`.
    fixed
        The name of the fixed frame.

    Returns
    -------
    tuple[dict[str, Pose], dict[str, list[str]]]
        The poses of the frames that are connected to the fixed one; and, by their root, the names
        of those that are not.

    """
    found = roots(samples)
    root, fixed_pose = found.get(fixed, (fixed, IDENTITY))
    to_fixed = inverse(fixed_pose)
    poses: dict[str, Pose] = {}
    others: dict[str, list[str]] = {}
    for frame, (top, pose) in found.items():
        if top == root:
            poses[frame] = chain(to_fixed, pose)
        else:
            others.setdefault(top, []).append(frame)
    return poses, others


def _climb(frame: str, samples: Mapping[str, Sample], found: dict[str, tuple[str, Pose]]) -> None:
    """Find the root of a frame, and of all frames on the way to it."""
    way: list[str] = []
    top = frame
    while top not in found:
        sample = samples.get(top)
        if sample is None:
            found[top] = top, IDENTITY
            break
        if len(way) > MAX_LINKS:
            return
        way.append(top)
        top = sample.parent
    for each in reversed(way):
        sample = samples[each]
        root, above = found[sample.parent]
        found[each] = root, chain(above, sample.pose)
