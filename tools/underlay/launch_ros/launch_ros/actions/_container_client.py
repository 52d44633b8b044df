# SPDX-License-Identifier: Apache-2.0
"""Client of the `load_node` service of a component container."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

from composition_interfaces.srv import LoadNode
from launch.logging import get_logger
from launch_ros._service_calls import ServiceCaller, ServiceGoneError

if TYPE_CHECKING:
    from launch_ros.actions._load_request import LoadRequest


class ContainerClient:
    """
    Client that loads composable nodes into a container, in order, and logs each result.

    Parameters
    ----------
    ros_node
        The launch's own rclpy node.
    container
        The fully qualified name of the container.
    process
        Done when the container has ended for good; None if this launch did not start it.

    """

    def __init__(
        self,
        ros_node: Any,
        container: str,
        process: Optional[asyncio.Future[Any]] = None,
    ) -> None:
        self._ros_node = ros_node
        self._container = container
        self._process = process
        self._logger = get_logger('launch_ros.actions.load_composable_nodes')
        self._caller: Optional[ServiceCaller] = None

    @property
    def has_asked(self) -> bool:
        """Whether a load request has been sent to the container."""
        return self._caller is not None and self._caller.has_asked

    async def load(self, requests: Iterable[LoadRequest]) -> None:
        """
        Load composable nodes; a failure of one does not affect the others.

        Parameters
        ----------
        requests
            The load requests, in order.

        """
        caller = self._caller = ServiceCaller(
            self._ros_node,
            LoadNode,
            self._container,
            '_container/load_node',
            self._logger,
            self._process,
        )
        try:
            for request in requests:
                await self._load_one(caller, request)
        finally:
            caller.close()

    async def _load_one(self, caller: ServiceCaller, request: LoadRequest) -> None:
        try:
            answer = await caller.call(request.to_message())
        except ServiceGoneError as error:
            self._report_failure(request, '', str(error))
            return
        if answer.success:
            name = answer.full_node_name or request.names.name_in_root
            self._logger.info("Loaded node '%s' in container '%s'", name, self._container)
        else:
            self._report_failure(request, answer.full_node_name, answer.error_message)

    def _report_failure(self, request: LoadRequest, full_name: str, why: str) -> None:
        self._logger.error(
            "Failed to load node '%s' of type '%s' in container '%s': %s",
            full_name or request.names.name or '',
            request.plugin,
            self._container,
            why,
        )
