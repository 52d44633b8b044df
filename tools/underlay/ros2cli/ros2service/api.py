# SPDX-License-Identifier: Apache-2.0
"""Services in the graph."""

from __future__ import annotations

from typing import Any

from ros2cli.names import closest, is_hidden

__all__ = [
    'get_service_names_and_types',
    'get_service_types',
    'service_hint',
    'unknown_service_text',
]


def get_service_names_and_types(
    *,
    node: Any,
    include_hidden_services: bool = False,
) -> list[tuple[str, list[str]]]:
    """
    List the services of the graph with their types, sorted by name.

    Parameters
    ----------
    node
        A `Graph`, which excludes the calling node, or any other object with
        `get_service_names_and_types`.
    include_hidden_services
        Whether to include services with a part that starts with an underscore.

    Returns
    -------
    list of tuple of str and list of str
        The services that have a server or a client.

    """
    return sorted(
        (name, types)
        for name, types in node.get_service_names_and_types()
        if include_hidden_services or not is_hidden(name)
    )


def get_service_types(node: Any, service: str) -> list[str]:
    """
    Return the types of a service, hidden or not.

    Parameters
    ----------
    node
        The `Graph`.
    service
        Full name of the service.

    Returns
    -------
    list of str
        The types; empty if the service has neither a server nor a client.

    """
    found = get_service_names_and_types(node=node, include_hidden_services=True)
    return dict(found).get(service, [])


def unknown_service_text(node: Any, service: str) -> str:
    """
    Format the error message for an unknown service, with a suggestion if a name is close.

    Parameters
    ----------
    node
        The `Graph`.
    service
        The service as the user wrote it.

    """
    hint = closest(service, _offered(node))
    return '\n'.join([f"Unknown service '{service}'", hint]).rstrip()


def service_hint(node: Any, service: str, type_name: str) -> str:
    """
    Explain why a service may not respond: it has another type or another name.

    Parameters
    ----------
    node
        The `Graph`.
    service, type_name
        The full name and the type that the client uses.

    Returns
    -------
    str
        The message, or '' if nothing is known to be wrong.

    """
    others = [name for name in get_service_types(node, service) if name != type_name]
    if others and node.count_services(service):
        return f"'{service}' has the type '{others[0]}', not '{type_name}'."
    return closest(service, [name for name in _offered(node) if name != service])


def _offered(node: Any) -> list[str]:
    names = [name for name, _ in get_service_names_and_types(node=node)]
    return [name for name in names if node.count_services(name)]
