# SPDX-License-Identifier: Apache-2.0
"""Packages that are not built: their interfaces can be shown, and using one is an error.

The files written here are replaced, one by one, when the package is built.
"""

from __future__ import annotations

from pathlib import Path
import shutil

from locations import Locations
from packages import Package
from wheels import site_packages

KINDS = ('action', 'msg', 'srv')
IN_PYTHON = """\
raise ImportError(
    '{sentence}',
    name='{name}',
)
"""
IN_CMAKE = 'message(FATAL_ERROR "{sentence}")\n'


def describe(package: Package, locations: Locations) -> None:
    """
    Install the interface definitions of a package, and stubs that raise an error when used.

    Importing an interface package in Python or finding it in CMake fails with that message.

    Parameters
    ----------
    package
        A package that is not built.
    locations
        The workspace, which the message names, and its environment.

    """
    environment = locations.environment
    definitions = [path for kind in KINDS for path in sorted(package.folder.glob(f'{kind}/*'))]
    share = environment / 'share' / package.name
    for path in (package.folder / 'package.xml', *definitions):
        target = share / path.relative_to(package.folder)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, target)
    why = 'it is built on demand' if package.on_demand else 'nothing in src/ depends on it'
    sentence = (
        f'{package.name} is not built yet, because {why}: run `make setup` in {locations.root}'
    )
    if package.on_demand:
        waiting = index(environment) / 'on_demand' / package.name
        waiting.parent.mkdir(parents=True, exist_ok=True)
        waiting.write_text(f'{" ".join(package.on_demand)}\n{sentence}\n', encoding='utf-8')
    if not package.is_interface:
        return
    names = '\n'.join(f'{path.parent.name}/{path.name}' for path in definitions)
    files = {
        share / 'cmake' / f'{package.name}Config.cmake': IN_CMAKE.format(sentence=sentence),
        index(environment) / 'rosidl_interfaces' / package.name: names,
        index(environment) / 'packages' / package.name: '',
    }
    in_python = site_packages(locations) / package.name / '__init__.py'
    files[in_python] = IN_PYTHON.format(sentence=sentence, name=package.name)
    for path, text in files.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding='utf-8')
    # An interrupted build lists a package in colcon's set-up files that has none of its own.
    (environment / 'share' / 'colcon-core' / 'packages' / package.name).unlink(missing_ok=True)


def forget(package: Package, locations: Locations) -> None:
    """
    Delete the stubs of a package that building it does not replace.

    Parameters
    ----------
    package
        A package that is built now.
    locations
        The workspace and its environment.

    """
    (index(locations.environment) / 'on_demand' / package.name).unlink(missing_ok=True)


def index(environment: Path) -> Path:
    """
    Return the folder of the ament index, by which packages and their interfaces are found.

    Parameters
    ----------
    environment
        The prefix that the index belongs to.

    """
    return environment / 'share' / 'ament_index' / 'resource_index'
