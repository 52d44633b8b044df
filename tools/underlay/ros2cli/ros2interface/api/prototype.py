# SPDX-License-Identifier: Apache-2.0
"""Default instances of interfaces for users to fill in."""

from __future__ import annotations

from typing import Any

from ros2cli.messages.lookup import get_passed_type, KINDS
from ros2interface.api.definition import read_definition, split_name

PARTS = {'srv': 'Request', 'action': 'Goal'}


def create_prototype(name: str) -> Any:
    """
    Create a message, the request of a service or the goal of an action, with default values.

    Parameters
    ----------
    name
        The interface as `package/kind/Type`.

    Returns
    -------
    Any
        The instance of the generated class.

    Raises
    ------
    RuntimeError
        There is no such interface, or its class cannot be imported.

    """
    _, kind, _ = split_name(name)
    if kind not in KINDS:
        raise RuntimeError(f"Unknown kind of interface '{kind}' in '{name}': {', '.join(KINDS)}")
    read_definition(name)
    interface = get_passed_type(name, kind)
    return getattr(interface, PARTS[kind])() if kind in PARTS else interface()
