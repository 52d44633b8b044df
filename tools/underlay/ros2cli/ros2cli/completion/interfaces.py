# SPDX-License-Identifier: Apache-2.0
"""Complete the types of messages, services and actions, and their values."""

from __future__ import annotations

import argparse

from ros2cli.completion.graph import types_of_service, types_of_topic
from ros2interface.api import get_interface_packages, get_interfaces

TYPES = ('message_type', 'service_type', 'action_type')


def packages(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the packages that define interfaces.

    Parameters
    ----------
    prefix, args
        The word to complete and the parsed arguments (both unused).

    """
    return get_interface_packages()


def interfaces(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the types of messages, services and actions.

    Parameters
    ----------
    prefix
        The word to complete; while several packages fit, only their names are listed.
    args : argparse.Namespace
        The parsed arguments (unused).

    """
    return _packages_first(prefix, ('msg', 'srv', 'action'))


def messages(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the types of messages.

    Parameters
    ----------
    prefix, args
        As for `interfaces`.

    """
    return _packages_first(prefix, ('msg',))


def actions(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the types of actions.

    Parameters
    ----------
    prefix, args
        As for `interfaces`.

    """
    return _packages_first(prefix, ('action',))


def messages_of_topic(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the types of a topic, or all message types if it does not exist yet.

    Parameters
    ----------
    prefix
        The word to complete, as for `interfaces`.
    args : argparse.Namespace
        The parsed arguments, with the `topic_name`.

    """
    return types_of_topic(args.topic_name) or messages(prefix, args)


def services_of_name(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the types of a service, or all service types if none is named or it does not exist.

    Parameters
    ----------
    prefix
        The word to complete, as for `interfaces`.
    args : argparse.Namespace
        The parsed arguments, with the `service_name` if the verb has one.

    """
    name = getattr(args, 'service_name', None)
    return (types_of_service(name) if name else []) or _packages_first(prefix, ('srv',))


def _packages_first(prefix: str, kinds: tuple[str, ...]) -> list[str]:
    package, slash, _ = prefix.partition('/')
    found = {
        name: types
        for name in get_interface_packages()
        if (name == package if slash else name.startswith(package))
        and (types := get_interfaces(name, kinds))
    }
    if len(found) > 1:
        return [f'{name}/' for name in found]
    return [text for types in found.values() for text in types]


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
    from ros2interface.definition import create_prototype

    name = next(filter(None, (getattr(args, each, None) for each in TYPES)))
    try:
        return [to_yaml(create_prototype(name), flow_style=True).strip()]
    except (AttributeError, ImportError, RuntimeError):
        return []
