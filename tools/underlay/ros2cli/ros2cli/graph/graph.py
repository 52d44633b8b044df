# SPDX-License-Identifier: Apache-2.0
"""Snapshot of the graph, with the introspection methods of an rclpy node."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from typing import Any

from ros2cli.names import REQUEST, RESPONSE, ros_name, ros_type, service_type, TOPIC
from ros2cli.rtps.entities import Endpoint, NodeEntities
from ros2cli.rtps.identifiers import PREFIX_BYTES

NamesAndTypes = list[tuple[str, list[str]]]


class Graph:
    """
    Snapshot of the graph without this command, with the introspection methods of an rclpy node.

    Parameters
    ----------
    nodes
        The nodes with their endpoints, as their participants describe them.
    endpoints
        All readers and writers.
    elsewhere
        The GUID prefixes (12 bytes) of the participants on other machines.

    """

    def __init__(
        self,
        nodes: Iterable[NodeEntities],
        endpoints: Iterable[Endpoint],
        elsewhere: Iterable[bytes] = (),
    ) -> None:
        self._elsewhere = frozenset(elsewhere)
        self._nodes = list(nodes)
        self._endpoints = list(endpoints)

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return the name and the namespace of each node."""
        return [(node.name, node.namespace) for node in self._nodes]

    def get_topic_names_and_types(self) -> NamesAndTypes:
        """Return the topics with publishers or subscriptions, and their types."""
        return _topics(self._endpoints)

    def get_service_names_and_types(self) -> NamesAndTypes:
        """Return the services with servers or clients, and their types."""
        return _services(self._endpoints, (REQUEST, RESPONSE))

    def get_publisher_names_and_types_by_node(self, name: str, namespace: str) -> NamesAndTypes:
        """
        Return the topics that a node publishes.

        Parameters
        ----------
        name, namespace
            Of the node, such as `talker` and `/`.

        Returns
        -------
        list of tuple
            Names with their types, sorted.

        """
        return _topics(self._of_node(name, namespace, are_writers=True))

    def get_subscriber_names_and_types_by_node(self, name: str, namespace: str) -> NamesAndTypes:
        """
        Return the topics that a node subscribes to.

        Parameters
        ----------
        name, namespace
            Of the node, such as `talker` and `/`.

        Returns
        -------
        list of tuple
            Names with their types, sorted.

        """
        return _topics(self._of_node(name, namespace, are_writers=False))

    def get_service_names_and_types_by_node(self, name: str, namespace: str) -> NamesAndTypes:
        """
        Return the services that a node offers.

        Parameters
        ----------
        name, namespace
            Of the node, such as `talker` and `/`.

        Returns
        -------
        list of tuple
            Names with their types, sorted.

        """
        return _services(self._of_node(name, namespace, are_writers=False), (REQUEST,))

    def get_client_names_and_types_by_node(self, name: str, namespace: str) -> NamesAndTypes:
        """
        Return the services that a node has a client of.

        Parameters
        ----------
        name, namespace
            Of the node, such as `talker` and `/`.

        Returns
        -------
        list of tuple
            Names with their types, sorted.

        """
        return _services(self._of_node(name, namespace, are_writers=False), (RESPONSE,))

    def count_publishers(self, topic: str) -> int:
        """
        Count the publishers of a topic.

        Parameters
        ----------
        topic
            The full name of the topic.

        """
        return sum(each.is_writer for each in self._ends(TOPIC, topic))

    def count_subscribers(self, topic: str) -> int:
        """
        Count the subscriptions to a topic.

        Parameters
        ----------
        topic
            The full name of the topic.

        """
        return len(self._readers(TOPIC, topic))

    def count_services(self, name: str) -> int:
        """
        Count the servers of a service.

        Parameters
        ----------
        name
            The full name of the service.

        """
        return len(self._readers(REQUEST, name))

    def count_clients(self, name: str) -> int:
        """
        Count the clients of a service.

        Parameters
        ----------
        name
            The full name of the service.

        """
        return len(self._readers(RESPONSE, name))

    def get_publishers_info_by_topic(self, topic: str) -> list[Any]:
        """
        Return the publishers of a topic, each as a TopicEndpointInfo of rclpy.

        Parameters
        ----------
        topic
            The full name of the topic.

        """
        return [self._info(each) for each in self._ends(TOPIC, topic) if each.is_writer]

    def get_subscriptions_info_by_topic(self, topic: str) -> list[Any]:
        """
        Return the subscriptions to a topic, each as a TopicEndpointInfo of rclpy.

        Parameters
        ----------
        topic
            The full name of the topic.

        """
        return [self._info(each) for each in self._readers(TOPIC, topic)]

    def is_elsewhere(self, info: Any) -> bool:
        """
        Whether a publisher or subscription is on another machine.

        Parameters
        ----------
        info
            Its TopicEndpointInfo, from one of the methods above.

        """
        return bytes(info.endpoint_gid[:PREFIX_BYTES]) in self._elsewhere

    def _readers(self, kind: str, name: str) -> list[Endpoint]:
        return [each for each in self._ends(kind, name) if not each.is_writer]

    def _ends(self, kind: str, name: str) -> list[Endpoint]:
        return [each for each in self._endpoints if ros_name(each.topic) == (kind, name)]

    def _of_node(self, name: str, namespace: str, *, are_writers: bool) -> list[Endpoint]:
        ids: set[bytes] = set()
        for node in self._nodes:
            if (node.name, node.namespace) == (name, namespace):
                ids |= node.writers if are_writers else node.readers
        return [each for each in self._endpoints if each.guid in ids]

    def _info(self, endpoint: Endpoint) -> Any:
        from ros2cli.graph.endpoint_info import endpoint_info

        return endpoint_info(endpoint, self._owners.get(endpoint.guid))

    @cached_property
    def _owners(self) -> dict[bytes, NodeEntities]:
        return {guid: node for node in self._nodes for guid in node.readers | node.writers}


def _topics(endpoints: Iterable[Endpoint]) -> NamesAndTypes:
    found: dict[str, set[str]] = {}
    for each in endpoints:
        known = ros_name(each.topic)
        if known and known.kind == TOPIC:
            found.setdefault(known.name, set()).add(ros_type(each.type_name))
    return _sorted(found)


def _services(endpoints: Iterable[Endpoint], kinds: tuple[str, ...]) -> NamesAndTypes:
    found: dict[str, set[str]] = {}
    for each in endpoints:
        known = ros_name(each.topic)
        if known and known.kind in kinds:
            found.setdefault(known.name, set()).add(service_type(each.type_name))
    return _sorted(found)


def _sorted(found: dict[str, set[str]]) -> NamesAndTypes:
    return [(name, sorted(types)) for name, types in sorted(found.items())]
