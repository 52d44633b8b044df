# SPDX-License-Identifier: Apache-2.0
"""Ask a container to load nodes."""

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
    Loads composable nodes into one container, in order, and logs the result of each.

    Parameters
    ----------
    ros_node
        The launch's own rclpy node.
    container
        The full name of the container.
    process
        Done when the container has ended for good; None if it is not of this launch.

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
        """Whether the container has been asked for a node."""
        return self._caller is not None and self._caller.has_asked

    async def load(self, requests: Iterable[LoadRequest]) -> None:
        """
        Load composable nodes; one that fails does not keep the others from being loaded.

        Parameters
        ----------
        requests
            What to load, in this order.

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
