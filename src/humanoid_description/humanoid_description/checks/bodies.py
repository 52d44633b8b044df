# SPDX-License-Identifier: Apache-2.0
"""Check that the masses and inertia tensors of links are physically consistent."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from humanoid_description.checks.outcome import Check, count
from humanoid_description.robot import Body, Link, named, Robot
import numpy as np

# Relative tolerance for principal moments that are rounded to few digits.
ROUNDING = 1e-3


def look_at_masses(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Sum the link masses, and find those that are not positive.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The total mass (kg) for the report, and a message for each defect.

    """
    defects = [
        f'{named(link)} has a mass of {link.body.mass_kg:g} kg. Give it a positive one, or '
        'leave out <inertial> if it is only a frame.'
        for link in robot.links
        if link.body and not link.body.mass_kg > 0
    ]
    bodies = sum(link.body is not None for link in robot.links)
    return f'{robot.mass_kg:.3f} kg in {count(bodies, "link")}', defects


def look_at_inertia(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Find inertia tensors that no rigid body can have.

    The principal moments must be positive and obey the triangle inequality.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The number of bodies for the report, and a message for each defect.

    """
    bodies = [(link, link.body) for link in robot.links if link.body]
    defects = [defect for link, body in bodies for defect in _wrong_moments(link, body)]
    return f'{len(bodies)} ' + ('body' if len(bodies) == 1 else 'bodies'), defects


def _wrong_moments(link: Link, body: Body) -> Iterator[str]:
    """Yield a message if the principal moments are impossible."""
    low, middle, high = np.linalg.eigvalsh(body.inertia_kgm2)
    if not low > 0:
        yield (
            f'{named(link)} has a principal moment of inertia of {low:g} kg m2. '
            'All three must be positive.'
        )
    elif high > (low + middle) * (1 + ROUNDING):
        yield (
            f'{named(link)} has a physically impossible inertia: the largest principal moment, '
            f'{high:g} kg m2, exceeds the sum of the other two, {low:g} and {middle:g}.'
        )


def look_at_moving_links(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Find links that a joint moves although they have no mass.

    Parameters
    ----------
    robot
        The model to check.

    Returns
    -------
    tuple
        The number of moving links for the report, and a message for each defect.

    """
    moved = [joint for joint in robot.joints if joint.is_driven]
    return count(len(moved), 'moving link'), [
        f"{named(robot.link[joint.child])} is moved by joint '{joint.name}', but neither it nor "
        'anything fixed to it has mass. Simulators reject this: add <inertial>.'
        for joint in moved
        if not _has_mass(robot, joint.child)
    ]


def _has_mass(robot: Robot, name: str) -> bool:
    """Check whether a link, or one that is fixed to it, has a body."""
    waiting = [name]
    while waiting:
        link = waiting.pop()
        if robot.link[link].body:
            return True
        waiting += [j.child for j in robot.joints if j.parent == link and j.kind == 'fixed']
    return False


BODIES = (
    Check('masses', look_at_masses),
    Check('inertia', look_at_inertia),
    Check('moving links', look_at_moving_links),
)
