# SPDX-License-Identifier: Apache-2.0
"""Check that mesh files exist."""

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
    remote = sum(_is_remote(file) for file in files)
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
            path = None if _is_remote(file) else _path(file, folder)
        except DescriptionError as error:
            yield f'{where} was not found: {error}'
            continue
        if path is not None and not path.is_file():
            yield f'{where} was not found: {_reason(path)}'


def _is_remote(file: str) -> bool:
    """Check whether the URI of a mesh refers to another machine."""
    scheme, separator, _ = file.partition('://')
    return bool(separator) and scheme not in ('file', 'package')


def _path(file: str, folder: Path) -> Path:
    """Resolve the path of a mesh; without a scheme it is relative to the folder of the URDF."""
    scheme, separator, rest = file.partition('://')
    if not separator:
        return folder / file
    if scheme == 'file':
        return Path(unquote(rest))
    package, _, inside = rest.partition('/')
    return _share(package) / inside


def _share(package: str) -> Path:
    """Return the share directory of a package; raise DescriptionError if it does not exist."""
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
    """Explain why a path is not a file, and suggest a similar one."""
    if path.is_dir():
        return f"'{path}' is a folder."
    if not path.parent.is_dir():
        return f"there is no folder '{path.parent}'."
    hint = did_you_mean(path.name, (each.name for each in path.parent.iterdir()))
    return f"there is no file '{path}'. " + (hint or 'Install it, or correct the name.')


MESHES = (Check('meshes', look_at_meshes),)
