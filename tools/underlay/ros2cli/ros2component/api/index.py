# SPDX-License-Identifier: Apache-2.0
"""The components that packages register in the ament index."""

from __future__ import annotations

from ament_index_python.resources import get_resource, get_resources

__all__ = ['get_component_packages', 'get_component_types']

RESOURCE = 'rclcpp_components'


def get_component_packages() -> list[str]:
    """Return the names of all packages with components, sorted."""
    return sorted(get_resources(RESOURCE))


def get_component_types(package: str) -> list[str]:
    """
    List the components that a package registers in the ament index.

    Parameters
    ----------
    package
        The name of the package.

    Returns
    -------
    list of str
        The class names, in the order of registration; empty if the package registers none.

    """
    try:
        content, _ = get_resource(RESOURCE, package)
    except LookupError:
        return []
    return [line.partition(';')[0] for line in content.splitlines() if line]
