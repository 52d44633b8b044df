# SPDX-License-Identifier: Apache-2.0
"""Whether the files of meshes are there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from urllib.parse import unquote

from humanoid_common.naming import did_you_mean
from humanoid_description.checks.outcome import Check, count
from humanoid_description.errors import DescriptionError
from humanoid_description.robot import line_of, Link, Robot, Shape


def look_at_meshes(robot: Robot) -> tuple[str, Iterable[str]]:
    """
    Find mesh files that are missing; those on other machines are not looked for.

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
    remote = sum(_is_remote(file) for file in files)
    found = count(len(files), 'file') + (f', {remote} not looked for' if remote else '')
    return found, [defect for link in robot.links for defect in _missing(link, robot.folder)]


def _meshes(link: Link) -> Iterator[Shape]:
    """Yield the meshes of a link."""
    yield from (shape for shape in (*link.visuals, *link.collisions) if shape.kind == 'mesh')


def _missing(link: Link, folder: Path) -> Iterator[str]:
    """Yield a sentence for every mesh of a link that is not there."""
    for file in dict.fromkeys(shape.file for shape in _meshes(link)):
        where = f"{line_of(link)}The mesh '{file}' of link '{link.name}'"
        try:
            path = None if _is_remote(file) else _path(file, folder)
        except DescriptionError as error:
            yield f'{where} is not there: {error}'
            continue
        if path is not None and not path.is_file():
            yield f'{where} is not there: {_reason(path)}'


def _is_remote(file: str) -> bool:
    """Tell whether only another machine can say if there is such a file."""
    scheme, separator, _ = file.partition('://')
    return bool(separator) and scheme not in ('file', 'package')


def _path(file: str, folder: Path) -> Path:
    """Return where a mesh is; a path without a scheme begins in the folder of the URDF."""
    scheme, separator, rest = file.partition('://')
    if not separator:
        return folder / file
    if scheme == 'file':
        return Path(unquote(rest))
    package, _, inside = rest.partition('/')
    return _share(package) / inside


def _share(package: str) -> Path:
    """Return the folder that a package shares, or say that there is no such package."""
    from ament_index_python.packages import (
        get_package_share_directory,
        get_packages_with_prefixes,
        PackageNotFoundError,
    )

    try:
        return Path(get_package_share_directory(package))
    except (PackageNotFoundError, ValueError) as error:
        hint = did_you_mean(package, get_packages_with_prefixes())
        raise DescriptionError(
            f"there is no package '{package}'. "
            + (hint or 'Install or build it, and source its setup file.')
        ) from error


def _reason(path: Path) -> str:
    """Say why a path is no file, and which one is meant perhaps."""
    if path.is_dir():
        return f"'{path}' is a folder."
    if not path.parent.is_dir():
        return f"there is no folder '{path.parent}'."
    hint = did_you_mean(path.name, (each.name for each in path.parent.iterdir()))
    return f"there is no file '{path}'. " + (hint or 'Install it, or correct the name.')


MESHES = (Check('meshes', look_at_meshes),)
