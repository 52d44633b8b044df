# SPDX-License-Identifier: Apache-2.0
"""Check that what the humanoid looks like is where it bumps into things."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from humanoid_description.checks.build import build_of, height_m
from humanoid_description.checks.outcome import count
from humanoid_description.mesh_files import bounds
from humanoid_description.robot import Array, Link, named, Robot, Shape
import numpy as np

# How far the visual shapes of a link may extend beyond its collision shapes, at scale 1.
MARGIN_M = 0.06


def look_at_shells(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Compare the bounding boxes of the visual and the collision shapes of each link that has both.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The largest excess (mm) of a visual shape for the report, and a message for each link
        whose visual shapes do not overlap its collision shapes, or extend too far beyond them.

    """
    both = [link for link in robot.links if link.visuals and link.collisions]
    found = [(link, _excess_m(link, robot)) for link in both]
    known = [(link, excess) for link, excess in found if excess is not None]
    margin_m = MARGIN_M * height_m(robot) / build_of(robot).height_m
    most_mm = 1000 * max((excess for _, excess in known if excess < np.inf), default=0.0)
    return f'{count(len(known), "link")}, at most {most_mm:.0f} mm outside', [
        f'{named(link)} has visual shapes that {_fault(excess)}. At most '
        f'{1000 * margin_m:.0f} mm are allowed, since people and cameras see the visual ones.'
        for link, excess in known
        if excess > margin_m
    ]


def _fault(excess_m: float) -> str:
    """Format how visual shapes differ from the collision shapes."""
    if np.isinf(excess_m):
        return 'do not overlap its collision shapes'
    return f'extend {1000 * excess_m:.0f} mm beyond its collision shapes'


def _excess_m(link: Link, robot: Robot) -> float | None:
    """
    Compute how far the visual shapes of a link extend beyond its collision shapes.

    Those of the links that it carries count too, since the ball of a joint covers both ends. The
    excess is infinite if nothing overlaps, and None if any of the shapes is not known.
    """
    seen, solid = _box(link.visuals, robot), _box(link.collisions, robot)
    if seen is None or solid is None:
        return None
    if np.any(seen[0] >= solid[1]) or np.any(seen[1] <= solid[0]):
        return float('inf')
    low, high = np.stack([solid, *_carried(link, robot)], axis=1)
    low, high = low.min(axis=0), high.max(axis=0)
    return float(max((low - seen[0]).max(), (seen[1] - high).max(), 0.0))


def _carried(link: Link, robot: Robot) -> Iterator[Array]:
    """Yield the boxes of the collision shapes of the children of a link, with joints at zero."""
    for joint in robot.joints:
        if joint.parent == link.name:
            for shape in robot.link[joint.child].collisions:
                box = bounds(shape, joint.pose, robot.folder)
                if box is not None:
                    yield box


def _box(shapes: Iterable[Shape], robot: Robot) -> Array | None:
    """Compute the bounding box (2, 3) of shapes in their link; None if one is not known."""
    boxes = []
    for shape in shapes:
        box = bounds(shape, np.eye(4), robot.folder)
        if box is None:
            return None
        boxes.append(box)
    low, high = np.stack(boxes, axis=1)
    return np.array([low.min(axis=0), high.max(axis=0)])
