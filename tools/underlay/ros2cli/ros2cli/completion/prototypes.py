# SPDX-License-Identifier: Apache-2.0
"""Complete the values of a message with defaults for the user to edit."""

from __future__ import annotations

import argparse

TYPES = ('message_type', 'service_type', 'action_type')


def values(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    Return the default values of an interface as one line of YAML.

    Parameters
    ----------
    prefix
        The word to complete (unused).
    args : argparse.Namespace
        The parsed arguments, with the `message_type`, `service_type` or `action_type`.

    Returns
    -------
    list of str
        The line alone; empty if the type is unknown.

    """
    from ros2cli.messages.text import to_yaml
    from ros2interface.api.prototype import create_prototype

    name = next(filter(None, (getattr(args, each, None) for each in TYPES)))
    try:
        return [to_yaml(create_prototype(name), flow_style=True).strip()]
    except (AttributeError, ImportError, RuntimeError):
        return []
