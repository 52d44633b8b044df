# SPDX-License-Identifier: Apache-2.0
"""The dependencies of packages, and the underlay packages that a command needs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from stamp import IGNORED

INTERFACES = 'rosidl_interface_packages'


@dataclass(frozen=True)
class Package:
    """A ROS package, as described by its package.xml.

    depends_on: the names in all of its tags such as depend, exec_depend and test_depend;
    is_interface: whether it defines messages, services or actions;
    on_demand: if not every command needs it, the words with which a command asks for it: those in
    the tag on_demand of its exports.
    """

    name: str
    folder: Path
    depends_on: frozenset[str]
    is_interface: bool
    on_demand: tuple[str, ...] = ()


def read_packages(folder: Path) -> dict[str, Package]:
    """
    Find the packages below a folder, by name, without those that colcon ignores.

    One whose package.xml cannot be read is left out: colcon reports the error.

    Parameters
    ----------
    folder
        The folder to search; a COLCON_IGNORE in this very folder is ignored.

    """
    found: dict[str, Package] = {}
    folders = [folder]
    while folders:
        here = folders.pop()
        if (here / 'COLCON_IGNORE').exists() and here != folder:
            continue
        if (here / 'package.xml').is_file():
            package = _read(here)
            if package:
                found[package.name] = package
        elif here.is_dir():
            folders += (path for path in here.iterdir() if _may_hold_packages(path))
    return found


def _may_hold_packages(path: Path) -> bool:
    return path.is_dir() and path.name not in IGNORED and not path.name.startswith('.')


def _read(folder: Path) -> Package | None:
    try:
        manifest = ElementTree.parse(folder / 'package.xml').getroot()
    except (ElementTree.ParseError, OSError):
        return None
    texts = {(element.tag, (element.text or '').strip()) for element in manifest}
    name = (manifest.findtext('name') or '').strip()
    dependencies = frozenset(text for tag, text in texts if tag.endswith('depend'))
    words = tuple((manifest.findtext('export/on_demand') or '').split())
    return Package(name, folder, dependencies, ('member_of_group', INTERFACES) in texts, words)


def needed(
    underlay: dict[str, Package], workspace: dict[str, Package], asked_for: str = ''
) -> set[str]:
    """
    Select the packages of the underlay that a command needs.

    These are all programs and libraries, and those interface packages, which are slow to build,
    that the workspace or another needed package depends on. Packages on demand, and workspace
    packages that only serve them, are included when the command names them.

    Parameters
    ----------
    underlay, workspace
        Packages of tools/underlay and of src/, by name.
    asked_for
        The arguments of the command; words that end in `:=false` are ignored.

    Returns
    -------
    set of str
        The names of the packages.

    """
    words = [word for word in asked_for.lower().split() if not word.endswith(':=false')]
    left_out = {
        name
        for name, package in underlay.items()
        if package.on_demand
        and not any(key in word for key in package.on_demand for word in words)
    }
    programs = (each for each in underlay.values() if not each.is_interface or each.on_demand)
    names = {package.name for package in programs} - left_out
    used = [package for package in workspace.values() if not package.depends_on & left_out]
    reached = names.union(*(package.depends_on for package in used))
    todo = [name for name in reached if name in underlay]
    found: set[str] = set()
    while todo:
        name = todo.pop()
        if name not in found:
            found.add(name)
            todo += (other for other in underlay[name].depends_on if other in underlay)
    return found - left_out
