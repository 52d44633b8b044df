# SPDX-License-Identifier: Apache-2.0
"""Which file of this machine a name in a URDF stands for."""

from __future__ import annotations

import os
from pathlib import Path
from urllib.parse import unquote, urlsplit

from ros_environment.suggestions import did_you_mean

__all__ = ['MeshError', 'find_file', 'find_mesh', 'folder_of']

KINDS = ('.stl', '.obj', '.glb', '.gltf', '.ply', '.dae')


class MeshError(ValueError):
    """A mesh that cannot be shown, with the reason."""


def find_mesh(name: str) -> Path:
    """
    Find the file of a mesh.

    Parameters
    ----------
    name
        As for `find_file`.

    Raises
    ------
    MeshError
        There is no such file, or its format is not supported.

    """
    path = find_file(name)
    if path.suffix.lower() not in KINDS:
        raise MeshError(
            f"'{name}' has a format that cannot be shown; supported are {', '.join(KINDS)}."
        )
    try:
        is_there = path.is_file()
    except OSError as error:
        raise MeshError(f"'{name}' cannot be read: {error.strerror}.") from None
    if not is_there:
        raise MeshError(f"'{name}' does not exist: {path} is not a file. {_meant(path)}".rstrip())
    return path


def folder_of(name: str) -> Path:
    """
    Find the folder whose files a mesh may use: its package, or else its own folder.

    Parameters
    ----------
    name
        As for `find_file`.

    Raises
    ------
    MeshError
        The name is invalid, or its package is not installed.

    """
    path = find_file(name)
    scheme, _, rest = name.partition('://')
    return _share(name, rest.partition('/')[0]) if scheme == 'package' else path.parent


def find_file(name: str) -> Path:
    """
    Resolve the name of a file in a URDF.

    Nothing is fetched from other machines. A path below a package stays there; its parts may be
    symbolic links, as colcon installs them with --symlink-install.

    Parameters
    ----------
    name
        An absolute path, or a URL that starts with `package://` or `file://`.

    Returns
    -------
    Path
        The path of the file, which need not exist.

    Raises
    ------
    MeshError
        The name is invalid, or its package is not installed.

    """
    if os.path.isabs(name):
        return Path(name)
    scheme, _, rest = name.partition('://')
    if not rest:
        raise MeshError(
            f"'{name}' is not an absolute path or URL. Write package://PACKAGE/{name.lstrip('./')}."
        )
    if scheme == 'package':
        return _in_package(name, *rest.partition('/')[::2])
    if scheme == 'file':
        return _local(name)
    raise MeshError(
        f"'{name}' is not fetched: only files of this machine are shown. Put it into a package, "
        'and name it package://PACKAGE/FILE.'
    )


def _local(name: str) -> Path:
    try:
        parts = urlsplit(name)
    except ValueError:
        raise MeshError(
            f"'{name}' is not a valid address. Write file:/// and an absolute path."
        ) from None
    if parts.netloc not in ('', 'localhost'):
        raise MeshError(
            f"'{name}' is on the machine '{parts.netloc}'. Write file:/// and an absolute path."
        )
    return Path(unquote(parts.path))


def _in_package(name: str, package: str, inside: str) -> Path:
    if '..' in unquote(inside).split('/') or os.path.isabs(unquote(inside)):
        raise MeshError(f"'{name}' is outside of package '{package}'. Name a file inside of it.")
    return _share(name, package) / unquote(inside)


def _share(name: str, package: str) -> Path:
    """Return the share folder of a package."""
    from ament_index_python.packages import (
        get_package_share_directory,
        get_packages_with_prefixes,
        PackageNotFoundError,
    )

    try:
        return Path(get_package_share_directory(package))
    except (PackageNotFoundError, ValueError):
        meant = did_you_mean(package, get_packages_with_prefixes(), 0.75)
        advice = f'{meant} Build it, and source the workspace before you start RViz.'.lstrip()
        raise MeshError(
            f"'{name}' is in package '{package}', which is not installed. {advice}"
        ) from None


def _meant(path: Path) -> str:
    """Suggest a file in the same folder with a similar name."""
    try:
        beside = [each.name for each in path.parent.iterdir() if each.name != path.name]
    except OSError:
        return ''
    return did_you_mean(path.name, beside, 0.75)
