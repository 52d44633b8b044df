# SPDX-License-Identifier: Apache-2.0
"""
Registry of components and their classes.

A package registers its components in the ament resource index, as C++ packages do, with the class
in place of the library: the resource `rclcpp_components` has a line such as
`nav2_amcl::AmclNode;nav2_amcl.amcl_node:AmclNode`. A Python package may also declare them in its
setup.py, as entry points of the group `rclcpp_components`.
"""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import entry_points
from typing import Any

from ament_index_python.packages import get_package_prefix, PackageNotFoundError
from ament_index_python.resources import get_resource
from ros_environment.suggestions import did_you_mean

__all__ = ['ComponentError', 'find_component', 'registered_components']

GROUP = 'rclcpp_components'


class ComponentError(Exception):
    """A component cannot be loaded or unloaded; the text states why."""


def registered_components(package: str) -> dict[str, str]:
    """
    List the components that a package registers.

    Parameters
    ----------
    package
        The name of the package.

    Returns
    -------
    dict
        The import paths of classes as `module:class`, or C++ libraries, by component name.

    """
    found: dict[str, str] = {}
    for each in entry_points(group=GROUP):
        if each.name.startswith(f'{package}::'):
            found[each.name] = each.value
    try:
        content, _ = get_resource(GROUP, package)
    except LookupError:
        return found
    for line in content.splitlines():
        name, _, place = line.partition(';')
        if name:
            found[name.strip()] = place.strip()
    return found


def find_component(package: str, name: str) -> Any:
    """
    Import the class of a component.

    Parameters
    ----------
    package
        The package that registers it.
    name
        Its name there, such as `nav2_amcl::AmclNode`.

    Raises
    ------
    ComponentError
        There is no such component, or its module cannot be imported.

    """
    components = registered_components(package)
    if name not in components:
        raise ComponentError(_why_not(package, name, list(components)))
    module, _, attribute = components[name].partition(':')
    if not attribute or '/' in module:
        raise ComponentError(
            f"'{name}' is a C++ library ({components[name]}); this container loads classes of "
            'Python only'
        )
    try:
        return getattr(import_module(module), attribute)
    except (ImportError, AttributeError) as error:
        raise ComponentError(f"'{name}' cannot be imported from '{module}': {error}") from error


def _why_not(package: str, name: str, known: list[str]) -> str:
    if not known:
        try:
            get_package_prefix(package)
        except (PackageNotFoundError, ValueError):
            return f"Could not find the package '{package}' in the index of resources"
        return f"The package '{package}' registers no components"
    meant = did_you_mean(name, known, 0.5) or f'It has {", ".join(known)}.'
    return f"Failed to find the class '{name}' in the package '{package}'. {meant}"
