# SPDX-License-Identifier: Apache-2.0
"""Check that links have masses and inertia tensors that are possible, and meshes that exist."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from humanoid_common.naming import did_you_mean
from humanoid_description.checks.outcome import Check, count
from humanoid_description.errors import DescriptionError
from humanoid_description.mesh_files import is_remote, mesh_path
from humanoid_description.robot import Body, line_of, Link, named, Robot, Shape
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


def look_at_meshes(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Find missing mesh files; remote ones are not checked.

    Parameters
    ----------
    robot
        The model to check; relative paths start in its folder.

    Returns
    -------
    tuple
        The number of files for the report, and a message for each missing one of a link.

    """
    files = {shape.file for link in robot.links for shape in _meshes(link)}
    remote = sum(is_remote(file) for file in files)
    found = count(len(files), 'file') + (f', {remote} remote not checked' if remote else '')
    return found, [defect for link in robot.links for defect in _missing(link, robot.folder)]


def _meshes(link: Link) -> Iterator[Shape]:
    """Yield the meshes of a link."""
    yield from (shape for shape in (*link.visuals, *link.collisions) if shape.kind == 'mesh')


def _missing(link: Link, folder: Path) -> Iterator[str]:
    """Yield a message for every missing mesh file of a link."""
    for file in dict.fromkeys(shape.file for shape in _meshes(link)):
        where = f"{line_of(link)}The mesh '{file}' of link '{link.name}'"
        try:
            path = None if is_remote(file) else mesh_path(file, folder)
        except DescriptionError as error:
            yield f'{where} was not found: {error}'
            continue
        if path is not None and not path.is_file():
            yield f'{where} was not found: {_reason(path)}'


def _reason(path: Path) -> str:
    """Explain why a path is not a file, and suggest a similar one."""
    if path.is_dir():
        return f"'{path}' is a folder."
    if not path.parent.is_dir():
        return f"there is no folder '{path.parent}'."
    hint = did_you_mean(path.name, (each.name for each in path.parent.iterdir()))
    return f"there is no file '{path}'. " + (hint or 'Install it, or correct the name.')


BODIES = (
    Check('masses', look_at_masses),
    Check('inertia', look_at_inertia),
    Check('moving links', look_at_moving_links),
)
MESHES = (Check('meshes', look_at_meshes),)
