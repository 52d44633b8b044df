# SPDX-License-Identifier: Apache-2.0
"""Where the packages of a student are: the workspace, its packages, and their manifests."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
import os
from pathlib import Path
from xml.etree import ElementTree

from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean, shortened
from humanoid_common.paths import expanded_path
from humanoid_course.report import quoted

MANIFEST = 'package.xml'
_IGNORE_MARKS = ('COLCON_IGNORE', 'AMENT_IGNORE', 'CATKIN_IGNORE')
_OUTPUT_FOLDERS = ('build', 'install', 'log')
_MOST_LEVELS = 6


@dataclass(frozen=True)
class Package:
    """A package in the source folder of a workspace."""

    name: str
    folder: Path


@dataclass(frozen=True)
class Manifest:
    """
    What a package.xml says.

    values: the text of each element, by tag; depends: names in elements of any kind of
    dependency; problem: why it cannot be read, if so.
    """

    values: Mapping[str, str] = field(default_factory=dict)
    depends: frozenset[str] = frozenset()
    email: str = ''
    problem: str = ''


def read_manifest(folder: Path) -> Manifest:
    """
    Read the manifest of a package, as far as it can be read.

    Parameters
    ----------
    folder
        The folder of the package.

    """
    try:
        root = ElementTree.parse(folder / MANIFEST).getroot()
    except (OSError, ElementTree.ParseError, ValueError) as error:
        return Manifest(problem=str(error))
    values = {each.tag: (each.text or '').strip() for each in root.iter()}
    depends = {(each.text or '').strip() for each in root if each.tag.endswith('depend')}
    maintainer = root.find('maintainer')
    email = '' if maintainer is None else maintainer.get('email', '')
    return Manifest(
        {**values, 'format': root.get('format', '1')}, frozenset(depends - {''}), email
    )


def find_packages(folder: Path) -> dict[str, Package]:
    """
    Find the packages below a folder, as colcon does, by name.

    Parameters
    ----------
    folder
        The folder; one that has a manifest is a package itself.

    """
    found: dict[str, Package] = {}
    for path in _package_folders(folder, _MOST_LEVELS):
        name = read_manifest(path).values.get('name') or path.name
        found.setdefault(name, Package(name, path))
    return found


def _package_folders(folder: Path, levels: int) -> Iterator[Path]:
    """Yield the folders with a manifest; packages do not contain others."""
    if any((folder / mark).exists() for mark in _IGNORE_MARKS):
        return
    if (folder / MANIFEST).is_file():
        yield folder
        return
    if levels == 0:
        return
    try:
        inside = sorted(each for each in folder.iterdir() if each.is_dir())
    except OSError:
        return
    for each in inside:
        if not each.name.startswith('.') and each.name not in _OUTPUT_FOLDERS:
            yield from _package_folders(each, levels - 1)


def find_workspace(
    given: str | None, wanted: Sequence[str], here: Path, variables: Mapping[str, str]
) -> tuple[Path, dict[str, Package]]:
    """
    Find the workspace with the wanted packages.

    Parameters
    ----------
    given
        The folder of the workspace as the user named it, if so.
    wanted
        The names of the packages.
    here
        The working directory: the workspace is sought upwards from it.
    variables
        Environment variables: then the sourced workspaces are searched.

    Returns
    -------
    Path, dict
        The folder of the workspace, and its packages by name, which include the wanted ones.

    Raises
    ------
    UserError
        There is no workspace, or a package is not in it.

    """
    if given is not None:
        folder = expanded_path(given).absolute()
        if not folder.is_dir():
            raise UserError(
                f"There is no folder '{shortened(given)}': give the path of your workspace, as in "
                '--workspace ~/ros2_ws.'
            )
        candidates = [folder]
    else:
        candidates = list(_candidates(here, variables))
    seen: list[tuple[Path, dict[str, Package]]] = []
    for folder in candidates:
        packages = find_packages(folder / 'src' if (folder / 'src').is_dir() else folder)
        if all(name in packages for name in wanted):
            return folder, packages
        seen.append((folder, packages))
    raise UserError(_not_found(wanted, seen))


def _candidates(here: Path, variables: Mapping[str, str]) -> Iterator[Path]:
    """Yield the folders that may be the student's workspace, the likeliest first."""
    above = next((each for each in (here, *here.parents) if (each / 'src').is_dir()), None)
    if above is not None:
        yield above
    elif here != Path.home():  # which may be large
        yield here
    for prefix in variables.get('COLCON_PREFIX_PATH', '').split(os.pathsep):
        folder = Path(prefix).parent
        if prefix and folder != above and (folder / 'src').is_dir():
            yield folder


def _not_found(wanted: Sequence[str], seen: Sequence[tuple[Path, dict[str, Package]]]) -> str:
    """Say which package is missing, with the closest name and what to do."""
    if not seen:
        return (
            'There is no workspace here: go to the folder of your workspace (cd ~/ros2_ws), or '
            'name it with --workspace.'
        )
    folder, packages = max(seen, key=lambda each: sum(name in each[1] for name in wanted))
    missing = next(name for name in wanted if name not in packages)
    option = '--package' if missing == wanted[0] else '--models'
    known = [name for _, found in seen for name in found]
    hint = did_you_mean(missing, known) or f'Packages there: {quoted(sorted(packages))}.'
    return (
        f"There is no package '{shortened(missing)}' in the workspace {folder}. {hint} If yours "
        f'has another name or place, give it with {option} or --workspace; otherwise create it '
        f'in the folder src: ros2 pkg create --build-type ament_python {shortened(missing)}.'
    )
