# SPDX-License-Identifier: Apache-2.0
"""Detection of parameters that a node does not declare."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from urdf.did_you_mean import did_you_mean

__all__ = ['unknown_parameters']

OF_ROS = ('use_sim_time', 'start_type_description_service', 'qos_overrides.')


def unknown_parameters(
    given: Iterable[str], known: Collection[str], prefixes: tuple[str, ...] = ()
) -> list[str]:
    """
    Format a warning for each parameter that the node does not declare.

    Parameters
    ----------
    given
        The names of the parameters that were given to the node.
    known
        The names that the node declares.
    prefixes
        Allowed prefixes of names, in addition to those of ROS.

    """
    return [
        f"There is no parameter '{name}'.{did_you_mean(name, known)}"
        for name in given
        if name not in known and not name.startswith((*OF_ROS, *prefixes))
    ]
